from bladerub.io.tables import described_columns
from bladerub.study import stress_table


def test_every_column_is_described():
    assert {*stress_table.COLUMNS} <= described_columns().keys()
