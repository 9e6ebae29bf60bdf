"""The script of ``bring_matrices.md`` reads what Abaqus and CalculiX write."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.io import mmread

PAGE = Path(__file__).parents[4] / "docs" / "how-to" / "bring_matrices.md"
MATRIX = np.array([[2.0, 0.5, -1.0], [0.5, 3.0, 0.0], [-1.0, 0.0, 4.0]])
WRITTEN = {
    "abaqus.mtx": "** MASS\n7,1, 7,1, 2.0\n7,2, 7,1, 0.5\n7,2, 7,2, 3.0\n7,3, 7,1, -1.0\n7,3, 7,3, 4.0\n",
    "rows.mtx": "1 1 2.0\n1 2 0.5\n1 3 -1.0\n2 1 0.5\n2 2 3.0\n3 1 -1.0\n3 3 4.0\n",
    "blade.sti": "1 1 4.0\n1 2 -1.0\n2 2 2.0\n2 3 0.5\n3 3 3.0\n",  # rows z, x, y
}


@pytest.mark.parametrize("name", WRITTEN)
def test_matrices_of_other_programs_become_matrix_market(name, tmp_path):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / "convert.py").write_text(code)
    (tmp_path / name).write_text(WRITTEN[name])
    if name == "blade.sti":
        (tmp_path / "blade.dof").write_text("7.3\n7.1\n7.2\n")
    subprocess.run([sys.executable, "convert.py", name, "out.mtx"], cwd=tmp_path, check=True)
    np.testing.assert_array_equal(mmread(tmp_path / "out.mtx").toarray(), MATRIX)
