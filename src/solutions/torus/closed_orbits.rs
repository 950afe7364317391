//! Closed orbits on a torus: period vectors, the times along the flows of `H` and `K` that lead back to the start, found
//! from the symmetries of the torus.
//!
//! In the principal frame a reflection in a coordinate plane maps a motion to a time-reversed one, and a half turn about an axis maps it to another
//! motion. With Y the axis of the middle eigenvalue of `s`, and Z one of the other two, the reflections in the planes `Y = 0` and `X = 0` and the
//! half turn about Z map a torus to itself. Angles `theta` counted from a state in the plane `Y = 0` then obey
//!
//! ```text
//! (n, L)(-theta) = F_Y (n, L)(theta),      (n, L)(theta_1, theta_2 + pi) = R_Z(pi) (n, L)(theta)
//! ```
//!
//! so that half a turn of either angle leads to a state in the plane again: two equations for the two times.

use nalgebra::{Matrix6x2, Vector2, Vector3};

use super::flow::{Axes, Integrals, apart, tangents};
use super::flow_series::FlowScalar;
use crate::numerics::angle::about;
use crate::numerics::scalar::Real;

/// Maximum number of Newton steps.
const MOST_CORRECTIONS: usize = 30;

/// Longest Newton step, in terms of the change of `n` and `L`.
const LONGEST_STEP: f64 = 0.4;

/// Changes of a condition below this, in radians per radian of the flow, are rounding: the motion does not depend on that angle.
const STILL: f64 = 1e-14;

/// Distance from the plane below which Newton's method is known to end in it.
const NEAR: f64 = 1e-9;

/// Allowed distance between the end of half the slow orbit and the half turn of its start: the rounding near the separatrix.
const WIDEST_GAP: f64 = 1e-7;

/// Half of a closed orbit: times along the flow of `H` and along that of `K`, from a state in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfPeriod<S> {
    pub(super) times: [S; 2],
    /// Rotation of the body about `n` (rad), relative to the vector normal to the plane or relative to the half turn about
    /// Z.
    pub(super) turn: S,
}

/// A torus and its closed orbits.
#[derive(Debug, Clone)]
pub(super) struct ClosedOrbits<S> {
    /// A state in the plane `Y = 0`, with `n x Y` as the vector of the body.
    pub(super) plane: Axes<S>,
    /// The path to it from the initial state. Its rotation angle is that from the plane's vector to the initial one.
    pub(super) to_plane: HalfPeriod<S>,
    /// Half a turn of `n` about `L`, seen from the plane of `L` and Z.
    pub(super) fast: HalfPeriod<S>,
    /// Half a turn of the averaged `L` about Z.
    pub(super) slow: HalfPeriod<S>,
}

impl<S: FlowScalar> ClosedOrbits<S> {
    /// Closed orbits near given times: the path to the plane, and half of the fast and of the slow orbit. `None` if there
    /// are none.
    pub(super) fn near(
        integrals: &Integrals<S>,
        unit: f64,
        initial: &Axes<S>,
        [to_plane, fast, slow]: [[S; 2]; 3],
    ) -> Option<Self> {
        let search = Search::new(integrals, unit);
        let (to_plane, end) = search.half_period(initial, to_plane, false)?;
        let plane = [end[0], end[1], end[0].cross(&Vector3::y())];
        let (fast, _) = search.half_period(&plane, fast, false)?;
        let (slow, end) = search.half_period(&plane, slow, true)?;
        let half_turned = plane.map(|v| half_turn(&v));
        (apart(&end, &half_turned, unit) < WIDEST_GAP).then_some(Self { plane, to_plane, fast, slow })
    }

    /// The times of [`near`](Self::near).
    pub(super) fn times(&self) -> [[S; 2]; 3] {
        [self.to_plane.times, self.fast.times, self.slow.times]
    }

    /// States along a quarter of a turn of the second angle, starting with the one in the plane, in `quarter` equal steps.
    pub(super) fn starts(&self, integrals: &Integrals<S>, quarter: usize) -> Vec<Axes<S>> {
        let step = self.slow.times.map(|time| time / (2 * quarter) as f64);
        let mut all = vec![self.plane];
        for m in 0..quarter {
            all.push(integrals.moved(step, &all[m]));
        }
        all
    }

    /// Angle (rad) by which the vector of the body is rotated at given turns of both angles.
    pub(super) fn turned(&self, [first, second]: [f64; 2]) -> f64 {
        2.0 * (self.fast.turn.re() * first + self.slow.turn.re() * second)
    }

    /// Rounded to doubles.
    pub(super) fn rounded(&self) -> ClosedOrbits<f64> {
        let half = |orbit: &HalfPeriod<S>| HalfPeriod { times: orbit.times.map(S::re), turn: orbit.turn.re() };
        ClosedOrbits {
            plane: self.plane.map(|v| v.map(S::re)),
            to_plane: half(&self.to_plane),
            fast: half(&self.fast),
            slow: half(&self.slow),
        }
    }
}

/// `v` rotated by half a turn about Z.
pub(super) fn half_turn<S: Real>(v: &Vector3<S>) -> Vector3<S> {
    Vector3::new(-v.x, -v.y, v.z)
}

/// A Newton step to the plane.
pub(super) struct StepToPlane<S> {
    /// Distances from the plane.
    left: Vector2<S>,
    /// Change of the times that would make them zero if the rates were constant.
    pub(super) change: Vector2<S>,
    /// Rates along both flows.
    pub(super) tangents: Matrix6x2<f64>,
}

impl<S: Real> StepToPlane<S> {
    /// Length of the step.
    pub(super) fn length(&self) -> f64 {
        (self.tangents * self.change.map(S::re)).norm()
    }
}

/// The search on a torus for states in the plane, and for paths between them.
pub(super) struct Search<'a, S> {
    integrals: &'a Integrals<S>,
    /// Unit of `L`.
    unit: f64,
    /// Unit of rates along both flows.
    rate: f64,
}

impl<'a, S: FlowScalar> Search<'a, S> {
    pub(super) fn new(integrals: &'a Integrals<S>, unit: f64) -> Self {
        Self { integrals, unit, rate: unit * integrals.inverse_inertia() }
    }

    /// Distance of `n`, minus its part along `L`, from the plane, and the distance of `L`, in units of their lengths.
    fn distances(&self, n: &Vector3<S>, momentum: &Vector3<S>, share: S) -> Vector2<S> {
        Vector2::new(n.y - share * momentum.y, momentum.y * S::from_f64(1.0 / self.unit))
    }

    /// `n.L / L^2`, the component of `n` along `L`; zero if `L` is small.
    fn share(&self, [n, momentum, _]: &Axes<S>) -> S {
        let square = momentum.dot(momentum);
        if square.re() < 0.01 * self.unit * self.unit { S::zero() } else { n.dot(momentum) / square }
    }

    pub(super) fn step_to_plane(&self, at: &Axes<S>) -> StepToPlane<S> {
        let share = self.share(at);
        let left = self.distances(&at[0], &at[1], share);
        let rates = self.integrals.both_rates(at);
        let [by_h, by_k] = rates.map(|[n, momentum, _]| self.distances(&n, &momentum, share));
        let change = step_to_zero([by_h, by_k], left, self.rate);
        StepToPlane { left, change, tangents: tangents(&rates, self.unit) }
    }

    /// The path near given times that ends in the plane `Y = 0`. Flows commute, so the rates at the end determine the Newton
    /// step.
    fn end_in_plane(&self, start: &Axes<S>, times: [S; 2]) -> Option<([S; 2], Axes<S>)> {
        self.on_to_plane(self.integrals.moved(times, start), times)
    }

    /// The state in the plane near the state at given times from the start.
    pub(super) fn on_to_plane(&self, mut at: Axes<S>, mut times: [S; 2]) -> Option<([S; 2], Axes<S>)> {
        let mut least = f64::INFINITY;
        for step in 0..MOST_CORRECTIONS {
            let found = self.step_to_plane(&at);
            let size = found.left.map(S::re).amax();
            if !size.is_finite() {
                return None;
            }
            // Derivatives require one step at the root.
            let near = size < NEAR;
            if step > 0 && (near && size >= 0.5 * least || size <= self.integrals.rounding()) {
                return near.then_some((times, at));
            }
            least = size;
            // Far from the plane the rates at the end are of little use.
            let length = found.length();
            let part = S::from_f64(if length > LONGEST_STEP { LONGEST_STEP / length } else { 1.0 });
            let change = [found.change.x * part, found.change.y * part];
            at = self.integrals.moved(change, &at);
            times = [times[0] + change[0], times[1] + change[1]];
        }
        None
    }

    /// The path near given times to a state in the plane. Its rotation angle is relative to the vector of the plane there or, if `slow`, relative to
    /// the vector of the start after half a turn about Z.
    fn half_period(&self, start: &Axes<S>, times: [S; 2], slow: bool) -> Option<(HalfPeriod<S>, Axes<S>)> {
        let (times, end) = self.end_in_plane(start, times)?;
        let from = if slow { half_turn(&start[2]) } else { end[0].cross(&Vector3::y()) };
        Some((HalfPeriod { times, turn: about(&end[0], &from, &end[2]) }, end))
    }
}

/// Changes of the times that cancel the distances, from the changes of the distances with each time. A distance that does not change with the times
/// is rounding, or the motion does not depend on that angle; it is ignored.
fn step_to_zero<S: Real>([by_h, by_k]: [Vector2<S>; 2], left: Vector2<S>, rate: f64) -> Vector2<S> {
    let norm = |row: &Vector2<S>| row.map(S::re).norm();
    // One flow may be much slower than the other.
    let scales = [norm(&by_h), norm(&by_k)].map(|size| S::from_f64(if size > STILL * rate { size } else { rate }));
    let rows = [0, 1].map(|i| Vector2::new(by_h[i] / scales[0], by_k[i] / scales[1]));
    let along = |row: &Vector2<S>, left: S| row * (-left / row.dot(row));
    let [first, second] = &rows;
    let change = match (norm(first) > STILL, norm(second) > STILL) {
        (false, false) => Vector2::zeros(),
        (true, false) => along(first, left.x),
        (false, true) => along(second, left.y),
        (true, true) => {
            let determinant = first.x * second.y - first.y * second.x;
            if determinant.re().abs() <= STILL * norm(first) * norm(second) {
                // If both distances change in proportion, on a circle: the best compromise of both.
                let share = second.dot(first) / first.dot(first);
                along(first, (left.x + share * left.y) / (S::one() + share * share))
            } else {
                Vector2::new(
                    (first.y * left.y - second.y * left.x) / determinant,
                    (second.x * left.x - first.x * left.y) / determinant,
                )
            }
        }
    };
    Vector2::new(change.x / scales[0], change.y / scales[1])
}

#[cfg(test)]
mod tests {
    use super::super::flow_series::DOUBLE;
    use super::super::lattice::lattice;
    use super::*;
    use crate::solutions::torus::plane::tests::BODY;

    /// With Y the axis of the middle value and `L` circling Z.
    fn found(strength: f64) -> (Integrals<f64>, Axes<f64>, ClosedOrbits<f64>) {
        let values = Vector3::new(-0.05, 0.0, 0.29) * strength;
        let integrals = Integrals::new(&BODY, &nalgebra::Matrix3::from_diagonal(&values), 0.34 * strength, DOUBLE);
        let start = [Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.4, -0.7, 1.9), Vector3::y()];
        let lattice = lattice(&integrals, 2.0, &start).unwrap();
        assert!(!lattice.about_x);
        let times = [lattice.to_plane, lattice.fast, lattice.slow];
        let orbits = ClosedOrbits::near(&integrals, 2.0, &start, times).unwrap();
        (integrals, start, orbits)
    }

    #[test]
    fn orbits_are_closed_and_turn_the_body_as_stated() {
        for strength in [0.3, 0.1, 0.01] {
            let (integrals, start, orbits) = found(strength);
            let [n, momentum, u] = orbits.plane;
            assert!(n.y.abs().max(momentum.y.abs()) < 1e-15, "{orbits:?}");
            // Back to the initial state, whose vector is ahead by the rotation angle of the path.
            let back = integrals.moved(orbits.to_plane.times.map(|time| -time), &orbits.plane);
            let gap = (back[0] - start[0]).amax().max((back[1] - start[1]).amax());
            assert!(gap < 1e-14, "{gap:e}");
            let ahead = integrals.moved(orbits.to_plane.times, &start)[2];
            let turned = |u: &Vector3<f64>, by: f64| u * by.cos() + n.cross(u) * by.sin();
            assert!((turned(&u, orbits.to_plane.turn) - ahead).amax() < 1e-14, "{orbits:?}");
            for orbit in [orbits.fast, orbits.slow] {
                let end = integrals.moved(orbit.times.map(|time| 2.0 * time), &orbits.plane);
                let gap = (end[0] - n).amax().max((end[1] - momentum).amax());
                assert!(gap < 1e-13, "{gap:e}");
                assert!((turned(&u, 2.0 * orbit.turn) - end[2]).amax() < 1e-13, "{orbit:?}");
            }
            // Half of the slow orbit is half a turn about Z.
            let half = integrals.moved(orbits.slow.times, &orbits.plane);
            assert!((half[0] - half_turn(&n)).amax().max((half[1] - half_turn(&momentum)).amax()) < 1e-13);
        }
    }

    #[test]
    fn a_condition_that_does_not_change_is_left_alone() {
        // Changes of both distances by either flow.
        let rows = |a: [f64; 2], b: [f64; 2]| [Vector2::new(a[0], b[0]), Vector2::new(a[1], b[1])];
        let left = Vector2::new(0.3, 0.2);
        let step = |a: [f64; 2], b: [f64; 2]| step_to_zero(rows(a, b), left, 1.0);
        assert_eq!(step([0.0; 2], [0.0; 2]), Vector2::zeros());
        assert_eq!(step([0.0; 2], [0.0, 2.0]), Vector2::new(0.0, -0.1));
        assert!((step([3.0, 0.0], [0.0; 2]).x + 0.1).abs() < 1e-15);
        // On a circle both distances change in proportion: they are cancelled as well as one number can.
        let met = step([3.0, 1.0], [6.0, 2.0]);
        let rest = Vector2::new(3.0 * met.x + met.y + 0.3, 6.0 * met.x + 2.0 * met.y + 0.2);
        assert!((rest.x + 2.0 * rest.y).abs() < 1e-15 && (met.y - 3.0 * met.x).abs() < 1e-15, "{met}");
        // A flow may be slow, but not as slow as rounding.
        assert_eq!((step([3.0, 0.0], [0.0, 2e-9]).y / 1e6).round(), -100.0);
        assert_eq!(step([3.0, 0.0], [0.0, 2e-15]).y, 0.0);
        let both = step([3.0, 1.0], [1.0, 2.0]);
        assert!((3.0 * both.x + both.y + 0.3).abs() < 1e-15 && (both.x + 2.0 * both.y + 0.2).abs() < 1e-15);
    }
}
