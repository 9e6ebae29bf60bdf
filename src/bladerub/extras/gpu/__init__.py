"""Many runs at once on one GPU, by the same steps as the time loop of `bladerub.contact.kernel`."""

ADDRESS = "BLADERUB_GPU"  # environment variable with the socket of `bladerub.extras.gpu.server`
