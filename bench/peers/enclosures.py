"""Enclosures of the family by codac: contractors for its conditions, and two ways to bisect."""
import collections
import heapq
import time

import codac
import numpy as np

import r228
from membership import (GAIN_TOL, LOOP_GAIN_MIN, LOOP_TOL, PARAMETERS, PHASE_TOL, SPREAD, XI_MAX)


def contractor(which):
    """For (omega_hz, xi, N, tau_s, phase) of each experiment, and the box to begin with."""
    x = codac.VectorVar(5 * len(which))
    parts, box = [], []

    def within(expression, low, high):
        parts.append(codac.CtcInverse(codac.AnalyticFunction([x], expression),
                                      codac.Interval(low, high)))

    for i, k in enumerate(which):
        omega, xi, n, tau, phase = (x[5 * i + j] for j in range(5))
        f, w = r228.FREQUENCY_HZ[k], r228.W[k]
        low = r228.GAIN[k] * (1 - GAIN_TOL)
        if r228.RELIABLE[k]:
            low = max(low, LOOP_GAIN_MIN / (w * abs(r228.FLAME_SLOPE[k])))
        within(2 * xi * codac.tan(phase) - (omega / f - f / omega), 0, 0)
        within(n * codac.cos(phase) / (4 * np.pi * omega * xi), low, r228.GAIN[k] * (1 + GAIN_TOL))
        within(phase - w * tau, -1.5 * np.pi - LOOP_TOL, -1.5 * np.pi + LOOP_TOL)
        box += [[100, 300], [0, XI_MAX], [0, 1e5], [0, 0.01],
                [r228.PHASE[k] - PHASE_TOL, r228.PHASE[k] + PHASE_TOL]]
    for i in range(len(which)):
        if i + 1 < len(which):
            within(x[5 * i + 1] - x[5 * i + 6], 0, codac.oo)
        for j in range(len(which)):
            if i != j:
                within(x[5 * i] / x[5 * j], 0, 1 + SPREAD)
    joined = parts[0]
    for part in parts[1:]:
        joined = joined & part
    fixpoint = codac.CtcFixpoint(joined)
    return lambda b: contracted(fixpoint, b), codac.IntervalVector(box)


def contracted(fixpoint, box):
    result = fixpoint.contract(box)
    return box if result is None else result


def bisect(box, scale, among=None):
    """Halves of the box along its widest side, of all or of some."""
    among = range(len(scale)) if among is None else among
    return box.bisect(max(among, key=lambda i: box[i].diam() / scale[i]))


def sivia(which, budget_s):
    """Breadth first, until the time is over; the hull of what is left."""
    contract, box = contractor(which)
    box = contract(box)
    scale = [box[i].diam() for i in range(box.size())]
    boxes, done, end = collections.deque([box]), 0, time.process_time() + budget_s
    while time.process_time() < end:
        halves = map(contract, bisect(boxes.popleft(), scale))
        boxes.extend(b for b in halves if not b.is_empty())
        done += 2
    hull = codac.IntervalVector(boxes[0])
    for box in boxes:
        hull |= box
    return enclosure(which, lambda i: (hull[i].lb(), hull[i].ub())), done


def best_first(which, budget_s, inner):
    """Each end by itself: the box that reaches farthest is halved, along the variables of the end's
    own experiment, until it reaches no farther than inner (howl's) by 1 % of that range, or its share
    of the time is over."""
    contract, box = contractor(which)
    root = contract(box)
    scale = [root[i].diam() for i in range(root.size())]
    done, ends, left = 0, {}, 8 * len(which)
    finish = time.process_time() + budget_s
    for i in [5 * e + j for e in range(len(which)) for j in range(4)]:
        low, high = inner[which[i // 5], PARAMETERS[i % 5]]
        own = range(i // 5 * 5, i // 5 * 5 + 5)
        for sign, wanted in ((-1, low), (1, high)):
            reach = lambda b: b[i].ub() if sign > 0 else -b[i].lb()
            heap, count = [(-reach(root), 0, root)], 0
            share = time.process_time() + (finish - time.process_time()) / left
            left -= 1
            while heap and -heap[0][0] > sign * wanted + 0.01 * (high - low) \
                    and time.process_time() < share:
                for half in map(contract, bisect(heapq.heappop(heap)[2], scale, own)):
                    count += 1
                    if not half.is_empty():
                        heapq.heappush(heap, (-reach(half), count, half))
            done += count
            ends[i, sign] = -sign * heap[0][0]
    return enclosure(which, lambda i: (ends[i, -1], ends[i, 1])), done


def enclosure(which, ends_of):
    return {(k, name): ends_of(5 * i + j) for i, k in enumerate(which)
            for j, name in enumerate(PARAMETERS)}
