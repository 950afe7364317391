//! States of a torus in the plane `Y = 0`, found by a search over the torus, and the paths between them.
//!
//! The reflection in the plane maps the torus to itself and reverses both angles: `theta -> c - theta`. It therefore leaves four states unchanged,
//! half a period apart from one another, and these are the states in the plane. Their times along both flows form a lattice, whose vectors are half
//! periods.

use nalgebra::{Vector2, Vector3};

use super::closed_orbits::{Search, half_turn};
use super::flow::{Axes, Integrals, apart, tangents};
use super::flow_series::COARSE;

/// Number of series along the flow of `K` from the start, and along that of `H` from each point on it.
const SIDES: [[usize; 2]; 2] = [[40, 2], [40, 40]];

/// Number of points evaluated on each series of the flows of `H` and of `K`.
const POINTS: [usize; 2] = [8, 5];

/// Newton's method begins where its steps are shorter than this, in terms of the change of `n` and `L`.
const NEAR: f64 = 0.7;

/// Distance from a circle at which a neighbouring torus is searched instead.
const MOVED: f64 = 1e-3;

/// Two predictions of a state are identical if they differ by less than this fraction of the path to it.
const SAME: f64 = 0.3;

/// Two states are identical if their times differ by less than the fraction `ONE`, or if the difference of the times moves the state by less than
/// `HERE` (rad): on a thin torus rounding changes the times.
const ONE: f64 = 1e-6;
const HERE: f64 = 1e-5;

/// Number of points along each side of a cell of the lattice at which states inside it are searched for.
const CELL: usize = 6;

/// The search stops after this many states in the plane: some are missing, or are found repeatedly.
const MOST_FOUND: usize = 64;

/// Widths of a torus, relative to its length, below which it is not searched: with few digits, some of which are lost to the thinness, and with all
/// digits. Below the second a neighbouring torus is searched instead.
const THIN: [f64; 2] = [1e-3, 1e-7];

/// Paths at a smaller angle, in terms of the change of `n` and `L`, are parallel.
const PARALLEL: f64 = 1e-4;

/// Part of the motion of the whole body that is added to that of `L`.
const SMALL_PART: f64 = 1e-12;

/// Half orbits end within this distance of the half turn of their start.
const HALF_TURN: f64 = 1e-4;

/// Times along both flows: from the start to the plane, and between two states in it, half of the fast and half of the slow
/// period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lattice {
    pub(super) to_plane: [f64; 2],
    pub(super) fast: [f64; 2],
    pub(super) slow: [f64; 2],
    /// Whether half of the slow period is half a turn about X instead of Z.
    pub(super) about_x: bool,
}

/// States in the plane of the torus through the state `start`. `None` if they are not found within so many steps.
pub(super) fn lattice(integrals: &Integrals<f64>, unit: f64, start: &Axes<f64>) -> Option<Lattice> {
    // A few digits suffice, except near the separatrix.
    [integrals.with(COARSE), *integrals].into_iter().zip(THIN).find_map(|(integrals, thin)| {
        let from = |start: &Axes<f64>| Walk::new(&integrals, unit, thin).from(start);
        match from(start) {
            Walked::Lattice(lattice) => return Some(lattice),
            Walked::Thin if thin == THIN[1] => (),
            _ => return None,
        }
        // The closed orbits of a circle are the limit of those of the tori about it: `n`, or `n` and `L`, are displaced.
        let [n, momentum, u] = start;
        let moved = Vector3::new(0.6, 0.5, -0.3) * MOVED;
        [0.0, unit].into_iter().find_map(|size| match from(&[(n + moved).normalize(), momentum + moved * size, *u]) {
            Walked::Lattice(lattice) => Some(lattice),
            _ => None,
        })
    })
}

/// `v` rotated by half a turn about X.
fn about_x(v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// The inner product of paths in a metric. That of a path with itself is its squared length.
fn along(metric: &Vector2<f64>, a: &Vector2<f64>, b: &Vector2<f64>) -> f64 {
    a.component_mul(metric).dot(b)
}

/// Paths that span the same lattice and are shortest in a metric, the shorter one first: Gauss' reduction.
fn reduced(metric: &Vector2<f64>, mut a: Vector2<f64>, mut b: Vector2<f64>) -> [Vector2<f64>; 2] {
    for _ in 0..100 {
        if along(metric, &a, &a) > along(metric, &b, &b) {
            (a, b) = (b, a);
        }
        let whole = (along(metric, &a, &b) / along(metric, &a, &a)).round();
        if whole == 0.0 {
            break;
        }
        b -= a * whole;
    }
    [a, b]
}

enum Walked {
    Lattice(Lattice),
    Thin,
    Nothing,
}

struct Walk<'a> {
    integrals: &'a Integrals<f64>,
    search: Search<'a, f64>,
    unit: f64,
    /// Width below which a torus counts as thin.
    thin: f64,
    /// Number of states evaluated.
    seen: f64,
    /// Sum over these states of the squared changes of `n` and `L` and of the squared rotation of the body, per time along
    /// each flow.
    metric: Vector2<f64>,
    /// The same sum for the changes of `L` alone, with a small part of the whole one, so that no path has the length zero.
    metric_of_momentum: Vector2<f64>,
    /// States in the plane, and the times from the start to them.
    found: Vec<(Vector2<f64>, Axes<f64>)>,
}

impl<'a> Walk<'a> {
    fn new(integrals: &'a Integrals<f64>, unit: f64, thin: f64) -> Self {
        let search = Search::new(integrals, unit);
        Self {
            integrals,
            search,
            unit,
            thin,
            seen: 0.0,
            metric: Vector2::zeros(),
            metric_of_momentum: Vector2::zeros(),
            found: Vec::new(),
        }
    }

    fn from(mut self, start: &Axes<f64>) -> Walked {
        if self.is_thin(start, 0.0) {
            return Walked::Thin;
        }
        for sides in SIDES {
            match self.over(start, sides) {
                Walked::Nothing => (),
                walked => return walked,
            }
        }
        Walked::Nothing
    }

    /// Follows the flow of `K` for a number of series, and from each point evaluated there the flow of `H` for a number of
    /// series.
    fn over(&mut self, start: &Axes<f64>, [steps, row]: [usize; 2]) -> Walked {
        // The parameter of a series is about the rotation angle of the body.
        let time = 1.0 / (self.unit * self.integrals.inverse_inertia());
        let points = |step: f64, count: usize| (0..count).map(move |part| step * part as f64 / count as f64);
        let (mut at, mut k) = (*start, 0.0);
        for _ in 0..steps {
            let slow = self.integrals.series([0.0, time], &at);
            for along in points(slow.step, POINTS[1]) {
                let (mut state, mut t) = (slow.at(along), 0.0);
                for _ in 0..row {
                    let fast = self.integrals.series([time, 0.0], &state);
                    for past in points(fast.step, POINTS[0]) {
                        if !self.look(&fast.at(past), Vector2::new(t + past, k + along) * time) {
                            continue;
                        }
                        if self.found.len() > MOST_FOUND {
                            return Walked::Nothing;
                        }
                        if self.found.len() == 1 && self.is_thin(&self.found[0].1, self.thin) {
                            return Walked::Thin;
                        }
                        if let Some(lattice) = self.complete() {
                            return Walked::Lattice(lattice);
                        }
                    }
                    state = fast.at(fast.step);
                    t += fast.step;
                }
            }
            at = slow.at(slow.step);
            k += slow.step;
        }
        Walked::Nothing
    }

    /// Whether both flows are parallel, or vanish; also if their rates are not finite.
    fn is_thin(&self, at: &Axes<f64>, thin: f64) -> bool {
        let tangents = tangents(&self.integrals.both_rates(at), self.unit);
        if !tangents.iter().all(|rate| rate.is_finite()) {
            return true;
        }
        let values = tangents.singular_values();
        values.min() <= thin * values.max()
    }

    /// Evaluates a state at given times from the start, and returns whether a state in the plane was found from it.
    fn look(&mut self, at: &Axes<f64>, times: Vector2<f64>) -> bool {
        let (step, turns) = (self.search.step_to_plane(at), self.integrals.turning_rates(at));
        self.seen += 1.0;
        for (flow, turn) in turns.iter().enumerate() {
            let tangent = step.tangents.column(flow);
            let whole = tangent.norm_squared() + turn.norm_squared();
            self.metric[flow] += whole;
            self.metric_of_momentum[flow] += tangent.rows(3, 3).norm_squared() + SMALL_PART * whole;
        }
        let length = step.length();
        let predicted = times + step.change;
        let is_known = |known: &Vector2<f64>| self.length(&(predicted - known)) <= SAME * self.length(&step.change);
        if length.is_nan() || length > NEAR || self.found.iter().any(|(known, _)| is_known(known)) {
            return false;
        }
        self.add(at, times)
    }

    /// Newton steps from a state to one in the plane that is not yet known.
    fn add(&mut self, at: &Axes<f64>, times: Vector2<f64>) -> bool {
        let Some((times, end)) = self.search.on_to_plane(*at, times.into()) else { return false };
        let times = Vector2::from(times);
        let apart = self.found.iter().map(|(known, _)| self.length(&(times - known)));
        let is_new = apart.fold(f64::INFINITY, f64::min) > HERE * self.seen.sqrt() + ONE * self.length(&times);
        if is_new {
            self.found.push((times, end));
        }
        is_new
    }

    /// Length of the path along the flows for given times, from the rotation of the body and the motion of `n` and `L`. It is a mean over the states
    /// evaluated, in which the flows cannot cancel.
    fn length(&self, times: &Vector2<f64>) -> f64 {
        along(&self.metric, times, times).sqrt()
    }

    /// The lattice of the states in the plane, if it is complete: no state is left inside a cell of those found.
    fn complete(&mut self) -> Option<Lattice> {
        'found: loop {
            let [a, b] = self.basis()?;
            let (origin, plane) = self.found[0];
            // They lie symmetrically, so half of the cell is sufficient.
            let mut row = plane;
            for i in 0..CELL {
                let mut at = row;
                for j in 0..=CELL / 2 {
                    let path = (a * i as f64 + b * j as f64) / CELL as f64;
                    if !at[0].x.is_finite() {
                        return None;
                    }
                    if (i, j) != (0, 0) && self.is_inside(&at, path, [a, b]) && self.add(&at, origin + path) {
                        continue 'found;
                    }
                    at = self.integrals.moved((b / CELL as f64).into(), &at);
                }
                row = self.integrals.moved((a / CELL as f64).into(), &row);
            }
            return self.named([a, b]);
        }
    }

    /// Whether a state in the plane is predicted near a state at the end of a path, other than at a corner of the cell of two
    /// paths.
    fn is_inside(&self, at: &Axes<f64>, path: Vector2<f64>, [a, b]: [Vector2<f64>; 2]) -> bool {
        let change = self.search.step_to_plane(at).change;
        let parts = [(path + change).perp(&b), a.perp(&(path + change))].map(|area| area / a.perp(&b));
        let beside = parts.into_iter().any(|part| (part - part.round()).abs() > SAME / CELL as f64);
        beside && self.length(&change) < 2.0 / CELL as f64 * self.length(&a).max(self.length(&b))
    }

    /// The shortest two independent paths between states that were found.
    fn basis(&self) -> Option<[Vector2<f64>; 2]> {
        let origin = self.found[0].0;
        let mut paths: Vec<_> = self.found[1..].iter().map(|(times, _)| times - origin).collect();
        paths.sort_by(|a, b| self.length(a).total_cmp(&self.length(b)));
        let unit = self.metric.product().sqrt();
        let first = *paths.first()?;
        let sine = |path: &Vector2<f64>| first.perp(path).abs() * unit / (self.length(&first) * self.length(path));
        let second = paths.iter().find(|path| sine(path) > PARALLEL)?;
        Some(reduced(&self.metric, first, *second))
    }

    /// Which of two paths and their sum leads to the half turn of the start, and which of the others is the fast one.
    fn named(&self, [a, b]: [Vector2<f64>; 2]) -> Option<Lattice> {
        let (to_plane, plane) = self.found[0];
        // L moves least along the fast orbit; along others it circles the axis.
        let of_momentum = &self.metric_of_momentum;
        let [a, b] = reduced(of_momentum, a, b);
        let b = b - a * (along(&self.metric, &a, &b) / along(&self.metric, &a, &a)).round();
        let ends = [a, b, a + b].map(|path| (path, self.integrals.moved(path.into(), &plane)));
        let turned = [(plane.map(|v| half_turn(&v)), false), (plane.map(|v| about_x(&v)), true)];
        let gaps =
            (0..3).flat_map(|i| turned.map(|(turned, about_x)| (apart(&ends[i].1, &turned, self.unit), i, about_x)));
        let (gap, place, is_about_x) = gaps.min_by(|(a, ..), (b, ..)| a.total_cmp(b))?;
        if gap > HALF_TURN {
            return None;
        }
        let slow = ends[place].0;
        // Whole periods of the other kind are subtracted from each.
        let less = |path: Vector2<f64>, by: Vector2<f64>, metric: &Vector2<f64>| {
            path - by * (2.0 * (along(metric, &path, &by) / along(metric, &by, &by) / 2.0).round())
        };
        let others = (0..3).filter(|i| *i != place).map(|i| less(ends[i].0, slow, of_momentum));
        let fast = others.min_by(|a, b| along(of_momentum, a, a).total_cmp(&along(of_momentum, b, b)))?;
        let slow = less(slow, fast, &self.metric);
        let forwards = |path: Vector2<f64>, flow: usize| path * path[flow].signum();
        let (fast, slow) = (forwards(fast, 0), forwards(slow, 1));
        // The same state, without whole periods from the start.
        let area = 2.0 * fast.perp(&slow);
        let to_plane = to_plane
            - fast * (2.0 * (to_plane.perp(&slow) / area).round())
            - slow * (2.0 * (fast.perp(&to_plane) / area).round());
        Some(Lattice { to_plane: to_plane.into(), fast: fast.into(), slow: slow.into(), about_x: is_about_x })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::super::flow_series::DOUBLE;
    use super::*;
    use crate::dynamics::{BodyState, Problem, RigidSpheroid};
    use crate::solutions::torus::TorusSolution;
    use crate::solutions::torus::plane::tests::BODY;

    #[test]
    fn flows_are_thin_where_they_vanish_or_are_not_finite() {
        let integrals = Integrals::new(&BODY, &Matrix3::from_diagonal(&Vector3::new(-0.4, 0.0, 0.6)), 1.0, DOUBLE);
        let walk = Walk::new(&integrals, 1.0, 1e-3);
        let axes = |n: Vector3<f64>, momentum| [n, momentum, n.cross(&Vector3::new(0.1, 0.7, -0.2))];
        let n = Vector3::new(0.48, 0.6, 0.64);
        assert!(!walk.is_thin(&axes(n, Vector3::new(0.3, -0.2, 0.5)), 1e-3));
        assert!(walk.is_thin(&axes(Vector3::z(), Vector3::z() * 9.0), 1e-3));
        assert!(walk.is_thin(&axes(n, Vector3::new(f64::NAN, 0.0, 0.5)), 0.0));
    }

    /// With large and small `L`, at rest, along `n`, on an axis, and with `n` in a potential well: half orbits end in the plane, one of them at the
    /// half turn of its start, and no state at half or a third of them is in the plane.
    #[test]
    fn half_periods_lead_from_plane_to_plane() {
        let values = Vector3::new(-0.4, 0.0, 0.6);
        let integrals = Integrals::new(&BODY, &Matrix3::from_diagonal(&values), 1.0, DOUBLE);
        let tilted = Vector3::<f64>::new(0.48, 0.6, 0.64);
        let starts: [(_, Vector3<f64>, _); 7] = [
            (tilted, Vector3::new(0.4, -0.7, 19.0), false),
            (tilted, Vector3::new(0.3, -0.2, 0.5), false),
            (tilted, Vector3::new(19.0, 0.6, 0.3), true),
            (tilted, Vector3::zeros(), true),
            (tilted, tilted * 9.0, false),
            (tilted, Vector3::z() * 9.0, false),
            (Vector3::new(0.995, 0.06, 0.08).normalize(), Vector3::new(0.1, 0.02, 0.03), true),
        ];
        for (n, momentum, is_about_x) in starts {
            let unit = momentum.norm().max(1.4);
            let start = [n, momentum, n.cross(&Vector3::new(0.1, 0.7, -0.2)).normalize()];
            let found = lattice(&integrals, unit, &start).unwrap();
            assert_eq!(found.about_x, is_about_x, "{n} {momentum}");
            let search = Search::new(&integrals, unit);
            let (_, plane) = search.on_to_plane(integrals.moved(found.to_plane, &start), found.to_plane).unwrap();
            let off = |[n, momentum, _]: &Axes<f64>| n.y.abs().max((momentum.y / unit).abs());
            let half = |paths: [[f64; 2]; 2], shares: [f64; 2]| {
                let times = [0, 1].map(|i| paths[0][i] * shares[0] + paths[1][i] * shares[1]);
                integrals.moved(times, &plane)
            };
            let at = |shares| half([found.fast, found.slow], shares);
            // Within the error of a few digits and of the neighbour of a circle.
            assert!(off(&at([1.0, 0.0])).max(off(&at([0.0, 1.0]))) < 1e-2, "{found:?}");
            let turned = if is_about_x { about_x } else { half_turn };
            let gap = apart(&at([0.0, 1.0]), &plane.map(|v| turned(&v)), unit);
            assert!(gap < 1e-2, "{gap:e} {found:?}");
            let between = [[0.5, 0.0], [0.0, 0.5], [0.5, 0.5], [1.0 / 3.0, 0.0], [0.0, 1.0 / 3.0]];
            let is_circle = [tilted * 9.0, Vector3::z() * 9.0].contains(&momentum);
            assert!(is_circle || between.into_iter().all(|shares| off(&at(shares)) > 1e-2), "{found:?}");
        }
    }

    /// A motion similar to tp-I with weaker and weaker violation: `L` is so near the axis that rounding changes the times to a state by up to a
    /// fraction of the path.
    #[test]
    fn thin_tori_are_found() {
        let star = RigidSpheroid::in_units_of_tc(1.1);
        for i in 0..400 {
            let scale = 10f64.powf(-0.01 * f64::from(i));
            let s = Matrix3::from_diagonal(&(Vector3::new(0.02, 0.01, -0.04) * scale));
            let start = BodyState {
                axis: Vector3::new(0.644_218_4, 0.0, 0.764_841_5).normalize(),
                momentum: Vector3::new(-0.034_468_46 * scale, 0.0, 1.438_23 + 0.009 * scale),
                equatorial_axis: Vector3::y(),
            };
            let found = TorusSolution::new(&Problem::new(star, s, start).unwrap(), 1e-13, 10.0).unwrap();
            let error = found.error_estimate(10.0);
            assert!(error < 1e-11, "{scale:e}: {error:e} {:?}", found.rates());
        }
    }
}
