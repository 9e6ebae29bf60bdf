"""Circumferential profile of the blade tip under one interface node (Fig. 3)."""

from __future__ import annotations

import numpy as np

from bladerub.contact.spec import TipProfile


def profile(tip: TipProfile, offset: np.ndarray) -> np.ndarray:
    """Height of the tip above its highest point, m (negative off the middle).

    Parameters
    ----------
    tip : TipProfile
        Half width and edge drop of the parabola.
    offset : array_like
        Tangential distance from the node, in element widths.
    """
    return -tip.edge_drop * (np.asarray(offset, dtype=float) / tip.half_width) ** 2


def coverage(tip: TipProfile, offset: np.ndarray) -> np.ndarray:
    """Share (0 to 1) of an element that lies under the tip.

    The coating force fades in and out with it, so that it does not jump when an element passes the
    edge of the profile.

    Parameters
    ----------
    tip : TipProfile
        Profile of the tip.
    offset : array_like
        Tangential distance of the element's centre from the node, in element widths.
    """
    return np.clip(tip.half_width + 0.5 - np.abs(offset), 0.0, 1.0)
