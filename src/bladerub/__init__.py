"""Rub of a compressor blade on the abradable coating of its casing.

Data flows one way: ``blade → contact → study → plots``.
"""

__version__ = "0.1.0"
