"""What other programs read: the motion of a run for ParaView."""
