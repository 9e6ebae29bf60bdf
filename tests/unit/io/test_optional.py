import pytest

from bladerub.io.errors import BadInput
from bladerub.io.optional import MissingPackage, package


def test_a_package_that_is_there():
    assert package("json.decoder", "study").JSONDecoder


def test_a_missing_one_is_bad_input_that_names_the_command():
    with pytest.raises(MissingPackage, match=r"^needs nowhere: pip install 'bladerub\[mesh\]'$") as raised:
        package("nowhere.at_all", "mesh")
    assert isinstance(raised.value, BadInput)
