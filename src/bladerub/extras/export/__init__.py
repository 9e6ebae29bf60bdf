"""What other programs read: the motion of a run, the mesh, decks for CalculiX, the reduced matrices."""
