"""A finished study on one page for the engineer of the machine."""
