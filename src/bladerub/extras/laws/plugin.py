"""Laws of the coating beside that of the paper."""

LAWS = {
    "brittle": "extras.laws.brittle",
    "perfectly_plastic": "extras.laws.perfectly_plastic",
    "thermal": "extras.laws.thermal",
    "viscoplastic": "extras.laws.viscoplastic",
}
