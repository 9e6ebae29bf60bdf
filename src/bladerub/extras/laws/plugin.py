"""Laws of the coating beside that of the paper."""

SECTIONS = {"contact.law": "extras.law_settings:Law"}
AGREEMENTS = {"contact": "extras.laws.agreement:problems"}
DATASETS = {"heat": "extras.laws.heating:DATASETS"}
PUBLIC = {"Law": "extras.laws.interface"}
RUN_OPTIONS = {"law": "extras.laws.run_option:LawOption"}
LAWS = {
    "brittle": "extras.laws.brittle",
    "perfectly_plastic": "extras.laws.perfectly_plastic",
    "thermal": "extras.laws.thermal",
    "viscoplastic": "extras.laws.viscoplastic",
}
VARIANTS = {"law": "extras.law_reading"}
NEEDS = ("variants",)
