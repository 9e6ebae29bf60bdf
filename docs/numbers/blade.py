"""Numbers of docs/explanation/blade.md."""

from docs.numbers import fixed, percent, row


def numbers(tables):
    """Return the text for each name on the page."""
    frequencies = tables["campbell"].set_index(["f_omega", "mode"])["f_fe"]
    error = row(tables["rom_accuracy"], f_omega=0.35, mode=2)
    return {
        "f1": fixed(frequencies[0, 1], 1),
        "stiffening": fixed(frequencies[0.4, 1] / frequencies[0, 1], 3),
        "modes_1_to_6": fixed(row(tables["findings"], id="C1a")["measured"], 2),
        "mode_7": fixed(row(tables["findings"], id="C1b")["measured"], 1),
        "speed_law": percent(abs(error["f_fe_eq2"] / error["f_fe"] - 1), 1),
    }
