"""Pictures drawn from tables and HDF5 files; nothing here simulates."""
