//! Closed ways on a torus: times along the flows of `H` and `K` that lead back to the start, by the symmetries of the torus.
//!
//! In the principal frame a reflection in a coordinate plane takes a motion to one that runs backwards, and a half turn about an axis takes it to
//! another motion. With Z the axis that the averaged `L` goes round, the reflections in the planes `Y = 0` and `X = 0` and the half turn about Z take a
//! torus to itself (where it has no state in the plane `Y = 0` it is refused). Angles `theta` from such a state then obey
//!
//! ```text
//! (n, L)(-theta) = F_Y (n, L)(theta),      (n, L)(theta_1, theta_2 + pi) = R_Z(pi) (n, L)(theta)
//! ```
//!
//! so that half a turn of either angle leads to a state of the plane again: two equations for the two times.

use core::f64::consts::TAU;

use nalgebra::{Vector2, Vector3};

use super::flow::{Axes, Integrals};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::numerics::angle::about;
use crate::numerics::scalar::{Real, length};
use crate::solutions::averaged::mean_direction;

/// Newton steps.
pub(super) const MOST_CORRECTIONS: usize = 30;

/// Longest of them, as an angle of turning.
const LONGEST_STEP: f64 = 0.3;

/// Steps in which the averaged `L` must come half round its axis; away from the separatrix it takes less than ten.
const MOST_STEPS: usize = 200;

/// Changes of a condition below this, in radians for a radian of the flow, are rounding: the motion does not depend on that angle.
const STILL: f64 = 1e-14;

/// What is left to close of a way that ends at the half turn of its start.
const WIDEST_GAP: f64 = 1e-9;

/// Half of a closed way: along the flow of `H` for the first time and along that of `K` for the second, from a state in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfWay<S> {
    pub(super) times: [S; 2],
    /// Turn of the body about `n` (rad), against the vector across the plane or against the half turn about Z.
    pub(super) turn: S,
}

/// A torus and its closed ways.
#[derive(Debug, Clone)]
pub(super) struct ClosedWays<S> {
    /// A state in the plane `Y = 0`, with `n x Y` for the vector of the body.
    pub(super) plane: Axes<S>,
    /// The way to it from the initial state. Its turn is that from the plane's vector to the initial one.
    pub(super) to_plane: HalfWay<S>,
    /// Half a turn of `n` about `L`, seen from the plane of `L` and Z.
    pub(super) fast: HalfWay<S>,
    /// Half a turn of the averaged `L` about Z.
    pub(super) slow: HalfWay<S>,
}

impl<S: Real> ClosedWays<S> {
    /// Closed ways from those of another precision.
    pub(super) fn refined(integrals: &Integrals<S>, initial: &Axes<S>, near: &ClosedWays<f64>) -> Option<Self> {
        let raised = |way: &HalfWay<f64>| way.times.map(S::from_f64);
        let search = Search::new(integrals, initial);
        let (to_plane, end) = search.half_way(initial, raised(&near.to_plane), false)?;
        let plane = with_vector_of_plane(&end);
        let (fast, _) = search.half_way(&plane, raised(&near.fast), false)?;
        let (slow, _) = search.half_way(&plane, raised(&near.slow), true)?;
        Some(Self { plane, to_plane, fast, slow })
    }

    /// States along a quarter of a turn of the second angle, from that in the plane on, so many steps apart.
    pub(super) fn starts(&self, integrals: &Integrals<S>, quarter: usize) -> Vec<Axes<S>> {
        let step = self.slow.times.map(|time| time / (2 * quarter) as f64);
        let mut all = vec![self.plane];
        for m in 0..quarter {
            all.push(integrals.moved(step, &all[m]));
        }
        all
    }

    /// Rounded to doubles.
    pub(super) fn rounded(&self) -> ClosedWays<f64> {
        let half = |way: &HalfWay<S>| HalfWay { times: way.times.map(S::re), turn: way.turn.re() };
        ClosedWays {
            plane: self.plane.map(|v| v.map(S::re)),
            to_plane: half(&self.to_plane),
            fast: half(&self.fast),
            slow: half(&self.slow),
        }
    }
}

fn with_vector_of_plane<S: Real>([n, momentum, _]: &Axes<S>) -> Axes<S> {
    [*n, *momentum, n.cross(&Vector3::y())]
}

/// `v` turned by half a turn about Z.
fn half_turn<S: Real>(v: &Vector3<S>) -> Vector3<S> {
    Vector3::new(-v.x, -v.y, v.z)
}

struct Search<'a, S> {
    integrals: &'a Integrals<S>,
    /// `|L|`.
    size: S,
    /// `|L| / I^xx`, the unit of rates along both flows.
    rate: f64,
}

impl<'a, S: Real> Search<'a, S> {
    fn new(integrals: &'a Integrals<S>, initial: &Axes<S>) -> Self {
        let size = length(&initial[1]);
        Self { integrals, size, rate: size.re() * integrals.inverse_inertia() }
    }

    /// Distance of `n` from the plane across `L`, and that of `L`, in units of their lengths.
    fn distances(&self, n: &Vector3<S>, momentum: &Vector3<S>, cosine: S) -> Vector2<S> {
        let across = momentum.y / self.size;
        Vector2::new(n.y - cosine * across, across)
    }

    /// The way near given times that ends in the plane `Y = 0`. Flows commute, so that the rates at the end lead there.
    fn end_in_plane(&self, start: &Axes<S>, mut times: [S; 2]) -> Option<([S; 2], Axes<S>)> {
        let mut at = self.integrals.moved(times, start);
        let mut least = f64::INFINITY;
        for step in 0..MOST_CORRECTIONS {
            let [n, momentum, _] = &at;
            let cosine = n.dot(momentum) / self.size;
            let left = self.distances(n, momentum, cosine);
            let size = left.map(S::re).amax();
            if !size.is_finite() {
                return None;
            }
            // Derivatives need one step from the root.
            let near = size < WIDEST_GAP;
            if step > 0 && (near && size >= 0.5 * least || size <= self.integrals.rounding()) {
                return near.then_some((times, at));
            }
            least = size;
            let rates = self.integrals.both_rates(&at);
            let [by_h, by_k] = rates.map(|[n, momentum, _]| self.distances(&n, &momentum, cosine));
            let change =
                step_to_zero([Vector2::new(by_h.x, by_k.x), Vector2::new(by_h.y, by_k.y)], left, STILL * self.rate)?;
            // Far from the plane the rates at the end say little.
            let turn = change.map(S::re).norm() * self.rate;
            let change = change * S::from_f64(if turn > LONGEST_STEP { LONGEST_STEP / turn } else { 1.0 });
            let change = [change.x, change.y];
            at = self.integrals.moved(change, &at);
            times = [times[0] + change[0], times[1] + change[1]];
        }
        None
    }

    /// The way near given times to a state in the plane, with its turn from the vector of the plane there or, if slow, from the half turn of the start's.
    fn half_way(&self, start: &Axes<S>, times: [S; 2], slow: bool) -> Option<(HalfWay<S>, Axes<S>)> {
        let (times, end) = self.end_in_plane(start, times)?;
        let from = if slow { half_turn(&start[2]) } else { end[0].cross(&Vector3::y()) };
        Some((HalfWay { times, turn: about(&end[0], &from, &end[2]) }, end))
    }
}

/// Times that change the distances by minus what they are. A distance that does not change with them is rounding, or the motion does not depend on that angle:
/// nothing is done about it.
fn step_to_zero<S: Real>(rows: [Vector2<S>; 2], left: Vector2<S>, still: f64) -> Option<Vector2<S>> {
    let norm = |row: &Vector2<S>| row.map(S::re).norm();
    let along = |row: &Vector2<S>, left: S| row * (-left / row.dot(row));
    let [first, second] = &rows;
    Some(match (norm(first) > still, norm(second) > still) {
        (false, false) => Vector2::zeros(),
        (true, false) => along(first, left.x),
        (false, true) => along(second, left.y),
        (true, true) => {
            let determinant = first.x * second.y - first.y * second.x;
            if determinant.re().abs() <= STILL * norm(first) * norm(second) {
                return None;
            }
            Vector2::new(
                (first.y * left.y - second.y * left.x) / determinant,
                (second.x * left.x - first.x * left.y) / determinant,
            )
        }
    })
}

/// What the closed ways are found from: a body, traceless principal values with Y the axis of the middle one and Z that which the averaged
/// `L` goes round.
pub(super) struct Courses<'a> {
    integrals: &'a Integrals<f64>,
    spheroid: &'a RigidSpheroid<f64>,
    values: &'a Vector3<f64>,
    /// Times along `H` and `K` of a turn of `n` about `L`, nearly.
    fast_turn: [f64; 2],
}

impl<'a> Courses<'a> {
    pub(super) fn new(
        integrals: &'a Integrals<f64>,
        spheroid: &'a RigidSpheroid<f64>,
        values: &'a Vector3<f64>,
        initial: &BodyState<f64>,
    ) -> Self {
        let size = initial.momentum.norm();
        let cosine = initial.axis.dot(&initial.momentum) / size;
        let t = TAU * spheroid.inertia_xx / size;
        // K takes back by how much the averaged torque turns L meanwhile.
        let spread = values.max() - values.min();
        let share = spheroid.constant_c * (3.0 * cosine * cosine - 1.0) / 2.0 * spread * spheroid.inertia_xx;
        Self { integrals, spheroid, values, fast_turn: [t, -t * share / (size * size)] }
    }

    /// Closed ways of the torus through a state.
    ///
    /// # Errors
    /// [`Error::NotConverged`] near the separatrix, and where the torus has no state in the plane.
    pub(super) fn closed_ways(&self, initial: &Axes<f64>) -> Result<ClosedWays<f64>, Error> {
        let search = Search::new(self.integrals, initial);
        let refused = |what| Error::NotConverged { what, iterations: MOST_CORRECTIONS, residual: f64::NAN };
        let found = search.half_way(initial, self.times_to_plane(initial)?, false);
        let (to_plane, end) = found.ok_or(refused("way to a state in a plane of principal axes"))?;
        let plane = with_vector_of_plane(&end);
        let guess = self.fast_turn.map(|time| time / 2.0);
        let fast = search.half_way(&plane, guess, false).ok_or(refused("way of n half round L"))?.0;
        let mut guess = self.times_to_plane(&plane)?;
        // The half turn of the start, or what is half a turn of n about L from it.
        let gap = |end: &Axes<f64>| {
            let apart = [0, 1].map(|i| (end[i] - half_turn(&plane[i])).amax());
            apart[0].max(apart[1] / search.size)
        };
        for _ in 0..2 {
            let found = search.half_way(&plane, guess, true).ok_or(refused("way of L half round its axis"))?;
            if gap(&found.1) < WIDEST_GAP {
                return Ok(ClosedWays { plane, to_plane, fast, slow: found.0 });
            }
            guess = [0, 1].map(|i| guess[i] + fast.times[i]);
        }
        Err(refused("way of L half round its axis, to the half turn of its start"))
    }

    /// Times, nearly, to the state in which the averaged `L` next crosses the plane, and `n` is in it.
    fn times_to_plane(&self, start: &Axes<f64>) -> Result<[f64; 2], Error> {
        let k = self.crossing(start)?;
        let part = self.part_of_turn(&self.integrals.moved([0.0, k], start));
        Ok([part * self.fast_turn[0], k + part * self.fast_turn[1]])
    }

    /// Time along `K` until the averaged `L` next crosses the plane.
    fn crossing(&self, start: &Axes<f64>) -> Result<f64, Error> {
        let direction = |[axis, momentum, equatorial_axis]: Axes<f64>| {
            mean_direction(self.spheroid, self.values, &BodyState { axis, momentum, equatorial_axis })
        };
        let (mut at, mut k, mut before) = (*start, 0.0, None);
        let first = direction(at);
        if first.x.hypot(first.y) < STILL {
            return Ok(0.0);
        }
        for _ in 0..MOST_STEPS {
            let series = self.integrals.series([0.0, 1.0], &at);
            let end = series.at(series.step);
            let y = direction(end).y;
            if let Some(before) = before.filter(|before: &f64| before * y <= 0.0) {
                // To some digits, by false position with the weight of an end that stays halved.
                let (mut ends, mut values) = ([0.0, series.step], [before, y]);
                for _ in 0..8 {
                    let middle = (ends[0] * values[1] - ends[1] * values[0]) / (values[1] - values[0]);
                    let value = direction(series.at(middle)).y;
                    let same = usize::from(value * values[1] > 0.0);
                    (ends[same], values[same]) = (middle, value);
                    values[1 - same] /= 2.0;
                    if value.abs() < 1e-6 * first.x.hypot(first.y) {
                        break;
                    }
                }
                let nearer = usize::from(values[1].abs() < values[0].abs());
                return Ok(k + ends[nearer]);
            }
            // A start in the plane is left first.
            before = Some(y);
            k += series.step;
            at = end;
        }
        Err(Error::NotConverged {
            what: "way of L round its axis: this is near the separatrix",
            iterations: MOST_STEPS,
            residual: first.y,
        })
    }

    /// Part of a turn of `n` about the averaged `L` that brings it to the plane, at most a quarter.
    fn part_of_turn(&self, at: &Axes<f64>) -> f64 {
        let [axis, momentum, equatorial_axis] = *at;
        let l = mean_direction(self.spheroid, self.values, &BodyState { axis, momentum, equatorial_axis });
        let first = Vector3::y().cross(&l).normalize();
        let turns = axis.dot(&l.cross(&first)).atan2(axis.dot(&first)) / TAU;
        ((2.0 * turns).round() / 2.0) - turns
    }
}

#[cfg(test)]
mod tests {
    use super::super::flow::DOUBLE;
    use super::*;
    use crate::solutions::torus::plane::tests::BODY;

    /// With Y the axis of the middle value and `L` round Z.
    fn found(strength: f64) -> (Integrals<f64>, Axes<f64>, ClosedWays<f64>) {
        let values = Vector3::new(-0.13, -0.08, 0.21) * strength;
        let integrals = Integrals::new(&BODY, &nalgebra::Matrix3::from_diagonal(&values), 0.34 * strength, DOUBLE);
        let start = [Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.4, -0.7, 1.9), Vector3::y()];
        let initial = BodyState { axis: start[0], momentum: start[1], equatorial_axis: start[2] };
        let ways = Courses::new(&integrals, &BODY, &values, &initial).closed_ways(&start).unwrap();
        (integrals, start, ways)
    }

    #[test]
    fn ways_are_closed_and_turn_the_body_as_told() {
        for strength in [0.3, 0.1, 0.01] {
            let (integrals, start, ways) = found(strength);
            let [n, momentum, u] = ways.plane;
            assert!(n.y.abs().max(momentum.y.abs()) < 1e-15, "{ways:?}");
            // Back to the initial state, whose vector is ahead by the turn of the way.
            let back = integrals.moved(ways.to_plane.times.map(|time| -time), &ways.plane);
            let gap = (back[0] - start[0]).amax().max((back[1] - start[1]).amax());
            assert!(gap < 1e-14, "{gap:e}");
            let ahead = integrals.moved(ways.to_plane.times, &start)[2];
            let turned = |u: &Vector3<f64>, by: f64| u * by.cos() + n.cross(u) * by.sin();
            assert!((turned(&u, ways.to_plane.turn) - ahead).amax() < 1e-14, "{ways:?}");
            for way in [ways.fast, ways.slow] {
                let end = integrals.moved(way.times.map(|time| 2.0 * time), &ways.plane);
                let gap = (end[0] - n).amax().max((end[1] - momentum).amax());
                assert!(gap < 1e-13, "{gap:e}");
                assert!((turned(&u, 2.0 * way.turn) - end[2]).amax() < 1e-13, "{way:?}");
            }
            // Half of the slow way is half a turn about Z.
            let half = integrals.moved(ways.slow.times, &ways.plane);
            assert!((half[0] - half_turn(&n)).amax().max((half[1] - half_turn(&momentum)).amax()) < 1e-13);
        }
    }

    #[test]
    fn a_condition_that_does_not_change_is_left_alone() {
        let rows = |a: [f64; 2], b: [f64; 2]| [Vector2::from(a), Vector2::from(b)];
        let left = Vector2::new(0.3, 0.2);
        assert_eq!(step_to_zero(rows([0.0; 2], [0.0; 2]), left, 1e-14), Some(Vector2::zeros()));
        assert_eq!(step_to_zero(rows([0.0; 2], [0.0, 2.0]), left, 1e-14), Some(Vector2::new(0.0, -0.1)));
        assert_eq!(step_to_zero(rows([3.0, 0.0], [0.0; 2]), left, 1e-14).map(|v| (v.x * 10.0).round()), Some(-1.0));
        assert_eq!(step_to_zero(rows([3.0, 1.0], [6.0, 2.0]), left, 1e-14), None);
        let both = step_to_zero(rows([3.0, 1.0], [1.0, 2.0]), left, 1e-14).unwrap();
        assert!((3.0 * both.x + both.y + 0.3).abs() < 1e-15 && (both.x + 2.0 * both.y + 0.2).abs() < 1e-15);
    }
}
