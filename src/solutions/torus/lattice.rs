//! Closed ways on a torus: times along the flows of `H` and `K` that lead back to the start.

use nalgebra::{SMatrix, SVector, Vector2, Vector3};

use super::flow::{Axes, Integrals};

/// Newton steps.
pub(super) const MOST_CORRECTIONS: usize = 30;

/// Newton steps along the fast angle alone.
const FAST_CORRECTIONS: usize = 4;

/// Parts of a turn, fast or slow, that are looked at.
pub(super) const PARTS_OF_TURN: usize = 48;

/// A torus whose two flows differ by less than this, relative, is a circle or a point.
const THINNEST: f64 = 1e-8;

/// Gap at which a way still counts as closed, near the separatrix, where rounding grows.
const WIDEST_GAP: f64 = 1e-8;

/// Rounding of a flow for a period.
pub(super) const ROUNDING: f64 = 1e-15;

/// A closed way on the torus: along the flow of `H` for the first time and along that of `K` for the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Period {
    pub(super) times: [f64; 2],
    /// Turn of the body about `n` (rad).
    pub(super) turn: f64,
    /// Estimated error of the times.
    pub(super) error: f64,
}

impl Period {
    /// This way, and another one backwards so many times.
    pub(super) fn without(&self, count: f64, other: &Period) -> Self {
        Self {
            times: [0, 1].map(|i| self.times[i] - count * other.times[i]),
            turn: self.turn - count * other.turn,
            error: self.error + count.abs() * other.error,
        }
    }
}

/// A torus by one of its points.
pub(super) struct Torus {
    pub(super) integrals: Integrals<f64>,
    pub(super) start: Axes<f64>,
    /// `|L|`.
    pub(super) size: f64,
}

impl Torus {
    fn vector(&self, [n, momentum]: [Vector3<f64>; 2]) -> SVector<f64, 6> {
        let l = momentum / self.size;
        SVector::from([n.x, n.y, n.z, l.x, l.y, l.z])
    }

    /// How far apart the ends of a way are of which the start is the middle.
    fn gap(&self, times: [f64; 2]) -> (SVector<f64, 6>, [Axes<f64>; 2]) {
        let ends = [0.5, -0.5].map(|half| self.integrals.moved(times.map(|time| time * half), &self.start));
        let [a, b] = &ends;
        (self.vector([a[0] - b[0], a[1] - b[1]]), ends)
    }

    /// The period near given times. Flows commute, so that the rates at an end close the gap.
    pub(super) fn period(&self, mut times: [f64; 2]) -> Option<Period> {
        let mut best: Option<(f64, Period)> = None;
        let mut worse = 0;
        for _ in 0..MOST_CORRECTIONS {
            let (gap, [end, other]) = self.gap(times);
            // A decomposition of what is not finite need not end.
            if !gap.norm().is_finite() {
                break;
            }
            let rates = [[1.0, 0.0], [0.0, 1.0]].map(|unit| self.vector(self.integrals.rates(unit, &end)));
            let columns: SMatrix<f64, 6, 2> = SMatrix::from_columns(&rates);
            let svd = columns.svd(true, true);
            let least = svd.singular_values.min();
            if least <= THINNEST * svd.singular_values.max() || !least.is_finite() {
                return None;
            }
            let change: Vector2<f64> = svd.solve(&gap, 0.0).ok()?;
            let size = gap.norm();
            if best.as_ref().is_none_or(|(smallest, _)| size < *smallest) {
                let [n, _, after] = end;
                let turn = n.dot(&other[2].cross(&after)).atan2(other[2].dot(&after));
                best = Some((size, Period { times, turn, error: (size + ROUNDING) / least }));
                worse = 0;
            } else {
                worse += 1;
            }
            if worse > 1 || size < 0.1 * ROUNDING {
                break;
            }
            times = [times[0] - change.x, times[1] - change.y];
        }
        best.filter(|(gap, _)| *gap < WIDEST_GAP).map(|(_, period)| period)
    }

    /// Once round the slow circle, from a time `k` along `K`: where along a turn of `n` about `L`, the time `fast`, that nearly leads back.
    pub(super) fn slow_period(&self, fast: [f64; 2], k: f64) -> Option<Period> {
        let distance = |at: &Axes<f64>| self.vector([at[0] - self.start[0], at[1] - self.start[1]]);
        let mut at = self.integrals.moved([0.0, k], &self.start);
        let part = fast.map(|time| time / PARTS_OF_TURN as f64);
        let mut nearest = (f64::INFINITY, 0);
        for parts in 0..PARTS_OF_TURN {
            let off = distance(&at).norm();
            if off < nearest.0 {
                nearest = (off, parts);
            }
            at = self.integrals.moved(part, &at);
        }
        let turned = nearest.1 as f64;
        let mut times = [part[0] * turned, k + part[1] * turned];
        // First the fast angle alone: the slow circle may be much smaller.
        let along = self.vector(self.integrals.rates(fast, &self.start));
        for _ in 0..FAST_CORRECTIONS {
            let turn = along.dot(&distance(&self.integrals.moved(times, &self.start))) / along.norm_squared();
            times = [0, 1].map(|i| times[i] - turn * fast[i]);
        }
        self.period(times)
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;
    use crate::solutions::torus::plane::tests::BODY;

    fn torus(strength: f64, momentum: [f64; 3]) -> Torus {
        let values = Vector3::new(0.21, -0.13, -0.08) * strength;
        let momentum = Vector3::from(momentum);
        let start = [Vector3::new(0.6, 0.0, 0.8), momentum, Vector3::y()];
        let integrals = Integrals::new(&BODY, &values, values.max() - values.min());
        Torus { integrals, start, size: momentum.norm() }
    }

    /// `n`, and `L` in units of its length: all parts of the start count.
    fn off(torus: &Torus, at: &Axes<f64>) -> f64 {
        let n = (at[0] - torus.start[0]).amax();
        n.max((at[1] - torus.start[1]).amax() / torus.start[1].norm())
    }

    #[test]
    fn ways_found_are_closed_and_turn_the_body_as_told() {
        for (strength, momentum) in [(0.3, [0.4, -0.7, 1.9]), (0.1, [1.6, 0.5, -0.4]), (0.03, [-0.3, 1.2, 1.1])] {
            let torus = torus(strength, momentum);
            let fast = TAU * BODY.inertia_xx / torus.size;
            let found = torus.period([fast, 0.0]).unwrap();
            let end = torus.integrals.moved(found.times, &torus.start);
            assert!(off(&torus, &end) < 1e-13, "{found:?}");
            // The vector of the body, turned about n.
            let [n, _, e] = torus.start;
            let turned = e * found.turn.cos() + n.cross(&e) * found.turn.sin();
            assert!((turned - end[2]).norm() < 1e-12, "{found:?} {turned} {}", end[2]);
            // A start that is off by a twentieth of a turn leads to the same way.
            let again = torus.period([1.05 * found.times[0], found.times[1]]).unwrap();
            assert!((0..2).all(|i| (again.times[i] - found.times[i]).abs() < 1e-12), "{found:?} {again:?}");
            // The error is the gap over how much a time moves the ends, where that is least: by the flows after the way.
            let rates = [[1.0, 0.0], [0.0, 1.0]].map(|unit| torus.vector(torus.integrals.rates(unit, &end)));
            let gram = SMatrix::<f64, 2, 2>::from_fn(|i, j| rates[i].dot(&rates[j]));
            let least = gram.symmetric_eigenvalues().min().sqrt();
            let gap = found.error * least;
            assert!(gap > 0.8 * ROUNDING && gap < 5.0 * ROUNDING, "{gap:e}");
        }
    }

    #[test]
    fn a_way_without_another_is_the_difference() {
        let period = |times, turn, error| Period { times, turn, error };
        let (long, short) = (period([7.0, 300.0], 2.5, 3e-3), period([1.5, 40.0], 0.4, 2e-4));
        let found = long.without(-2.0, &short);
        let wanted = period([10.0, 380.0], 3.3, 3.4e-3);
        for (a, b) in [(found.turn, wanted.turn), (found.error, wanted.error)] {
            assert!((a / b - 1.0).abs() < 1e-15, "{found:?}");
        }
        assert_eq!(found.times, wanted.times);
        assert!((long.without(3.0, &short).error / 3.6e-3 - 1.0).abs() < 1e-15);
        assert_eq!(long.without(3.0, &short).times, [2.5, 180.0]);
    }

    /// A flow that is slower by far than the other one leads nowhere within rounding.
    #[test]
    fn flows_along_one_way_span_no_torus() {
        for (slower, exists) in [(1.0, true), (1e6, true), (1e10, false)] {
            let mut torus = torus(0.3, [0.4, -0.7, 1.9]);
            torus.integrals = Integrals::new(&BODY, &(Vector3::new(0.21, -0.13, -0.08) * 0.3), 0.102 * slower);
            let found = torus.period([TAU * BODY.inertia_xx / torus.size, 0.0]);
            assert_eq!(found.is_some(), exists, "{slower}: {found:?}");
        }
    }

    #[test]
    fn what_does_not_close_is_no_way() {
        let torus = torus(0.3, [0.4, -0.7, 1.9]);
        assert_eq!(torus.period([f64::NAN, 0.0]), None);
        assert_eq!(torus.period([f64::INFINITY, 0.0]), None);
        // n along L along a principal axis: a point.
        let values = Vector3::new(0.21, -0.13, -0.08);
        let integrals = Integrals::new(&BODY, &values, 0.34);
        let point = Torus { integrals, start: [Vector3::z(), Vector3::z() * 2.0, Vector3::y()], size: 2.0 };
        assert_eq!(point.period([4.0, 0.1]), None);
    }
}
