"""Blades from meshes, tables of sections and matrices of other programs."""

SECTIONS = {"blade.source": "extras.blades.settings:Source", "contact.scale": "extras.blades.settings:Scale"}
SOURCES = {"matrices": "extras.blades.matrix_source", "file": "extras.blades.file_source"}
COMMANDS = {"import": "extras.blades.command"}
