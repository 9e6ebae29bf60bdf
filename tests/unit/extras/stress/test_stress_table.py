from bladerub.extras.stress import table as stress_table
from bladerub.io.tables import described_columns


def test_every_column_is_described():
    assert {*stress_table.COLUMNS} <= described_columns().keys()
