//! Fundamental frequencies of a motion: mean rates of its angles, from their winding numbers along the angles of the torus.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use super::Combination;
use crate::dynamics::{BodyState, RotationState};
use crate::numerics::angle::{about, wrapped};
use crate::numerics::double_double::DoubleDouble;

/// Number of points of the first and of the finest grid in each angle. If an Euler angle still jumps between two points of the finest
/// grid, `n` passes a pole.
const POINTS: [usize; 2] = [32, 256];

/// With this many points or more, four neighbours whose azimuths wind once enclose the pole of `alpha`, or miss it by at most
/// `(2 pi / 64)^2 / 8 = 1.2e-3` of the curvature of `n` on the torus. The finest grid only resolves poles farther from `n` than half of its step,
/// `0.5 * 2 pi / 256 = 1.2e-2`, and need not be computed.
const FINE: usize = 64;

/// Largest change of an angle between two points of the grid (rad), below a quarter turn.
const LARGEST_STEP: f64 = 1.5;

/// A sum of rates below this fraction of its terms is rounding: rates have 32 digits.
const CANCELLED: f64 = 1e-30;

/// An averaged `L` below this fraction of its largest value is rounding.
const SMALLEST_MOMENTUM: f64 = 1e-9;

/// The mean rate of an angle of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FundamentalFrequency {
    /// `alpha'`, `gamma'`, `l'`, `nu'` or `psi'`.
    pub symbol: &'static str,
    /// The rate, of either sign (rad per unit of time).
    pub rate: f64,
    /// Winding number of the angle with respect to each of the three angles of the torus.
    pub turns: [i32; 3],
}

/// Mean rates of the angles of a motion, and a set of independent ones.
///
/// A continuous angle of the state on the torus has an integer winding number with respect to each angle of the torus; with these integers as
/// coefficients, its mean rate is a sum of the rates of the angles of the torus. The angles, about the principal axis of `s^IJ` that the
/// averaged `L` circles (Z for a free motion), are:
///
/// * `alpha'`, `gamma'`: the Euler angles `alpha` and `gamma`. They have no mean rate if `n` comes arbitrarily close to a pole of the axis.
/// * `l'`: the azimuth of `L` averaged over the fast rotation, the slow precession. Neither `l'` nor `nu'` is defined if the averaged `L` passes
///   zero, as after a start from rest.
/// * `nu'`: the rotation of the fast part of `n` about the averaged `L`, from the plane of `L` and the axis: the nutation.
/// * `psi'`: the rotation of `e_x` about `n`, from the direction in which that part of `n` moves, or from a fixed direction if there is no
///   such part.
#[derive(Debug, Clone, PartialEq)]
pub struct FundamentalFrequencies {
    /// The principal axis of `s^IJ` to which the angles refer; Z for a free motion.
    pub pole: Vector3<f64>,
    /// All fundamental frequencies.
    pub all: Vec<FundamentalFrequency>,
    /// The basis: every line is an integer combination of these. They are `alpha'`, `gamma'` and `l'`, or `nu'` where `alpha'` is a multiple of
    /// `l'`; without `alpha'` and `gamma'` the others are used, and the angles of the torus themselves where these do not name every line.
    pub basis: Vec<FundamentalFrequency>,
}

impl FundamentalFrequencies {
    /// The frequencies of a motion on the torus, from the state as a function of the turns of its three angles, and their
    /// rates (turns per unit of time).
    pub(super) fn of(
        state: impl Fn([f64; 3]) -> BodyState<f64>,
        rates: [DoubleDouble; 3],
        pole: &Vector3<f64>,
    ) -> Self {
        let mut grid = Grid::new(&state, POINTS[0], pole);
        let euler = loop {
            let euler = grid.euler_windings();
            if euler.is_some() || grid.count >= POINTS[1] || grid.count >= FINE && grid.surrounds_pole() {
                break euler;
            }
            grid = Grid::new(&state, 2 * grid.count, pole);
        };
        let mut all = Vec::new();
        let mut add = |symbol, turns: [i32; 3]| {
            all.push(FundamentalFrequency { symbol, rate: rate_of(&rates, turns), turns });
        };
        if let Some([alpha, gamma]) = euler {
            add("alpha'", alpha);
            add("gamma'", gamma);
        }
        // A body that starts from rest oscillates: its averaged L does not circle any axis.
        if grid.has_momentum() {
            add("l'", grid.slow());
            add("nu'", grid.nutation());
        }
        add("psi'", grid.body());
        let moving = rates.map(|rate| rate.high != 0.0);
        let mut basis = basis(&all, moving);
        if basis.is_empty() {
            // The angles of the torus themselves.
            let unit = |i: usize| core::array::from_fn(|j| i32::from(i == j));
            let angles = ["theta_1'", "theta_2'", "theta_3'"].into_iter().enumerate().filter(|(i, _)| moving[*i]);
            basis = angles
                .map(|(i, symbol)| FundamentalFrequency { symbol, rate: rate_of(&rates, unit(i)), turns: unit(i) })
                .collect();
        }
        Self { pole: *pole, all, basis }
    }

    /// The rate of the fundamental frequency with this symbol (rad per unit of time), if the motion has it.
    pub fn rate(&self, symbol: &str) -> Option<f64> {
        self.all.iter().find(|found| found.symbol == symbol).map(|found| found.rate)
    }

    /// The combination of the basis with given integer multiples of the angles of the torus.
    pub(super) fn combination(&self, multiples: [i32; 3]) -> Combination {
        // The rows are integers and the determinant is one, so the inverse has integer entries.
        let rows = completed(&self.basis);
        let wanted = nalgebra::RowVector3::from(multiples.map(f64::from));
        let inverse = rows.try_inverse().expect("a basis has the determinant one");
        let terms = (wanted * inverse).iter().zip(&self.basis).map(|(k, of)| (k.round() as i32, of.symbol)).collect();
        Combination { terms }
    }
}

/// Rate (turns per unit of time) of a combination of angles; zero if only the rounding of 32 digits is left of its terms.
pub(super) fn turns_of(rates: &[DoubleDouble; 3], multiples: [i32; 3]) -> DoubleDouble {
    let terms = rates.iter().zip(multiples).map(|(rate, k)| *rate * DoubleDouble::from(f64::from(k)));
    let sum = terms.clone().fold(DoubleDouble::from(0.0), |sum, term| sum + term);
    let size: f64 = terms.map(|term| term.high.abs()).sum();
    if sum.high.abs() <= CANCELLED * size { DoubleDouble::from(0.0) } else { sum }
}

/// Rate (rad per unit of time) of a combination of angles, rounded once.
pub(super) fn rate_of(rates: &[DoubleDouble; 3], multiples: [i32; 3]) -> f64 {
    (turns_of(rates, multiples) * DoubleDouble::TAU).high
}

/// The rows of a basis, completed with unit vectors along the angles that do not move.
fn completed(basis: &[FundamentalFrequency]) -> Matrix3<f64> {
    let mut rows = Matrix3::zeros();
    for (i, of) in basis.iter().enumerate() {
        rows.set_row(i, &nalgebra::RowVector3::from(of.turns.map(f64::from)));
    }
    let mut next = basis.len();
    for angle in 0..3 {
        if next < 3 && basis.iter().all(|of| of.turns[angle] == 0) {
            rows[(next, angle)] = 1.0;
            next += 1;
        }
    }
    rows
}

/// The first independent subset of the frequencies of which all moving angles are integer combinations.
fn basis(all: &[FundamentalFrequency], moving: [bool; 3]) -> Vec<FundamentalFrequency> {
    let dimension = moving.iter().filter(|moves| **moves).count();
    let of_moving: Vec<_> = all
        .iter()
        .map(|of| FundamentalFrequency { turns: [0, 1, 2].map(|i| if moving[i] { of.turns[i] } else { 0 }), ..*of })
        .collect();
    let choices = [&["alpha'", "gamma'", "l'"][..], &["alpha'", "gamma'", "nu'"], &["alpha'", "gamma'"]];
    let others = [&["gamma'", "nu'"][..], &["l'", "nu'", "psi'"], &["nu'", "psi'"], &["psi'"], &["nu'"]];
    for choice in choices.into_iter().chain(others).filter(|choice| choice.len() == dimension) {
        let found = choice.iter().map(|symbol| of_moving.iter().find(|of| of.symbol == *symbol).copied());
        if let Some(found) = found.collect::<Option<Vec<_>>>()
            && completed(&found).determinant().abs().round() == 1.0
        {
            return found;
        }
    }
    Vec::new()
}

/// States on the torus: a grid in the first two angles, and a loop in the third one.
struct Grid {
    count: usize,
    /// In the frame whose third axis is the axis of the angles.
    states: Vec<BodyState<f64>>,
    third: Vec<BodyState<f64>>,
    /// `n` and `L` averaged over the first angle, for each point of the second one.
    means: Vec<[Vector3<f64>; 2]>,
}

impl Grid {
    fn new(state: &impl Fn([f64; 3]) -> BodyState<f64>, count: usize, pole: &Vector3<f64>) -> Self {
        let frame = frame(pole);
        let at = |turns: [f64; 3]| state(turns).rotated(&frame);
        let part = |i: usize| i as f64 / count as f64;
        let states: Vec<_> =
            (0..count).flat_map(|k| (0..count).map(move |j| [part(j), part(k), 0.0])).map(at).collect();
        let third = (0..POINTS[0]).map(|l| at([0.0, 0.0, l as f64 / POINTS[0] as f64])).collect();
        let mean = |row: &[BodyState<f64>], of: fn(&BodyState<f64>) -> Vector3<f64>| {
            row.iter().map(of).sum::<Vector3<f64>>() / count as f64
        };
        let means = states.chunks(count).map(|row| [mean(row, |state| state.axis), mean(row, |state| state.momentum)]);
        let means = means.collect();
        Self { count, states, third, means }
    }

    /// Winding number of an angle with respect to each angle of the torus; `None` if it jumps. It is the same along all parallel loops: if it
    /// differed between two, the steps around a cell between them would add to a turn, and one of the four would be a quarter turn or more.
    fn windings(&self, angle: impl Fn(&BodyState<f64>, usize) -> f64) -> Option<[i32; 3]> {
        let count = self.count;
        let angles: Vec<f64> = self.states.iter().enumerate().map(|(i, state)| angle(state, i / count)).collect();
        let loops = |of: usize| {
            let along = |from: usize, step: usize| winding((0..count).map(|i| angles[from + i * step]));
            [along(of * count, 1), along(of, count)]
        };
        let [first, second] = loops(0);
        if (1..count).flat_map(loops).any(|around| around.is_none()) {
            return None;
        }
        Some([first?, second?, winding(self.third.iter().map(|state| angle(state, 0)))?])
    }

    /// Whether the azimuth of `n` winds once counter-clockwise around some cell of four neighbouring points. One sense is sufficient: the windings of
    /// all cells cancel on a torus, so that both occur equally often.
    fn surrounds_pole(&self) -> bool {
        let count = self.count;
        let azimuth = |k: usize, j: usize| {
            let n = &self.states[k % count * count + j % count].axis;
            n.y.atan2(n.x)
        };
        let goes_round = |k: usize, j: usize| {
            let corners = [azimuth(k, j), azimuth(k, j + 1), azimuth(k + 1, j + 1), azimuth(k + 1, j)];
            let steps = (0..4).map(|i| wrapped(corners[(i + 1) % 4] - corners[i]));
            steps.sum::<f64>() > 1.0
        };
        (0..count).any(|k| (0..count).any(|j| goes_round(k, j)))
    }

    fn euler_windings(&self) -> Option<[[i32; 3]; 2]> {
        let alpha = self.windings(|state, _| state.angles().map_or(f64::NAN, |angles| angles.alpha))?;
        let gamma = self.windings(|state, _| state.angles().map_or(f64::NAN, |angles| angles.gamma))?;
        Some([alpha, gamma])
    }

    /// Turns of the fast part of `n` about the averaged `L`, from the plane of `L` and the axis, or from a fixed plane if that `L` stays on the axis.
    fn nutation(&self) -> [i32; 3] {
        let from_plane = self.windings(|state, k| {
            let [n, momentum] = self.means[k];
            let l = momentum.normalize();
            let plane = Vector3::z() - l * l.z;
            about(&l, &plane, &(state.axis - n))
        });
        let sense = || sign(area(self.states[..self.count].iter().map(|state| state.axis), &self.means[0][1]));
        from_plane.filter(|turns| turns[0].abs() == 1).unwrap_or_else(|| [sense(), 0, 0])
    }

    /// Whether the averaged `L` is nowhere zero.
    fn has_momentum(&self) -> bool {
        let sizes = || self.means.iter().map(|[_, momentum]| momentum.norm());
        sizes().fold(f64::INFINITY, f64::min) > SMALLEST_MOMENTUM * sizes().fold(0.0, f64::max)
    }

    /// Winding numbers of the averaged `L` about the axis.
    fn slow(&self) -> [i32; 3] {
        [0, sign(area(self.means.iter().map(|[_, momentum]| *momentum), &Vector3::z())), 0]
    }

    /// Turns of `e_x` about `n`, from the direction in which the fast part of `n` circles the averaged `L`, or from a fixed direction if `n` has no
    /// such part.
    fn body(&self) -> [i32; 3] {
        let from_across = self.windings(|state, k| {
            let [n, momentum] = self.means[k];
            let across = momentum.cross(&(state.axis - n));
            about(&state.axis, &across, &state.equatorial_axis)
        });
        let fixed = Vector3::ith(self.states[0].axis.iamin(), 1.0);
        let from_fixed = || self.windings(|state, _| about(&state.axis, &fixed, &state.equatorial_axis));
        let sense = || sign(area(self.third.iter().map(|state| state.equatorial_axis), &self.third[0].axis));
        let counted = |turns: &[i32; 3]| turns[2].abs() == 1;
        from_across.filter(counted).or_else(|| from_fixed().filter(counted)).unwrap_or_else(|| [0, 0, sense()])
    }
}

/// Winding number of an angle along a loop; `None` if it jumps.
fn winding(angles: impl Iterator<Item = f64> + Clone) -> Option<i32> {
    let mut sum = 0.0;
    for (a, b) in angles.clone().zip(angles.cycle().skip(1)) {
        let step = wrapped(b - a);
        // NaN counts as a jump.
        if step.is_nan() || step.abs() > LARGEST_STEP {
            return None;
        }
        sum += step;
    }
    Some((sum / TAU).round() as i32)
}

/// Twice the area enclosed by a loop of points, about a direction.
fn area(points: impl Iterator<Item = Vector3<f64>> + Clone, direction: &Vector3<f64>) -> f64 {
    points.clone().zip(points.cycle().skip(1)).map(|(a, b)| a.cross(&b).dot(direction)).sum()
}

fn sign(value: f64) -> i32 {
    if value < 0.0 { -1 } else { 1 }
}

/// A rotation that takes a unit vector to Z.
fn frame(pole: &Vector3<f64>) -> Matrix3<f64> {
    let least = pole.iamin();
    let x = pole.cross(&Vector3::ith(least, 1.0)).normalize();
    Matrix3::from_rows(&[x.transpose(), pole.cross(&x).transpose(), pole.transpose()])
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    /// `L` circles Z, `n` circles `L` and `e_x` circles `n`, each once with one angle of the torus; `n` and `e_x` also circle additional times with
    /// the second.
    fn turning(tilt: f64, opening: f64, more: [f64; 2]) -> impl Fn([f64; 3]) -> BodyState<f64> {
        leaning(tilt, 0.0, opening, more)
    }

    /// As `turning`, but with a cone of `n` whose axis leans away from `L`.
    fn leaning(tilt: f64, lean: f64, opening: f64, more: [f64; 2]) -> impl Fn([f64; 3]) -> BodyState<f64> {
        let about_y = |angle| Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
        let about_z = |turns: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), TAU * turns);
        move |[a, b, c]| {
            let momentum = about_z(-b) * about_y(tilt);
            let cone = momentum * about_y(lean) * about_z(a + more[0] * b);
            let body = cone * about_y(opening) * about_z(more[1] * a - c);
            BodyState {
                axis: body * Vector3::z(),
                momentum: momentum * Vector3::z() * 1.5,
                equatorial_axis: body * Vector3::x(),
            }
        }
    }

    fn found(state: impl Fn([f64; 3]) -> BodyState<f64>) -> FundamentalFrequencies {
        let rates = [1.3, 0.01, 0.2].map(|rate: f64| DoubleDouble::from(rate / TAU));
        FundamentalFrequencies::of(state, rates, &Vector3::z())
    }

    fn turns(found: &FundamentalFrequencies, symbol: &str) -> Option<[i32; 3]> {
        found.all.iter().find(|of| of.symbol == symbol).map(|of| of.turns)
    }

    #[test]
    fn turns_are_counted_along_the_angles_of_the_torus() {
        // Twofold precession, n far from L.
        let twofold = found(turning(0.3, 0.9, [0.0, 0.0]));
        assert_eq!(turns(&twofold, "l'"), Some([0, -1, 0]));
        assert_eq!(turns(&twofold, "nu'"), Some([1, 0, 0]));
        assert_eq!(turns(&twofold, "alpha'"), Some([1, -1, 0]));
        assert_eq!(turns(&twofold, "gamma'"), Some([0, 0, -1]));
        assert!((twofold.rate("alpha'").unwrap() - 1.29).abs() < 1e-15 && twofold.rate("beta'").is_none());
        let symbols = |found: &FundamentalFrequencies| found.basis.iter().map(|of| of.symbol).collect::<Vec<_>>();
        assert_eq!(symbols(&twofold), ["alpha'", "gamma'", "l'"]);
        // Single precession, n near L; other angles on the same torus.
        let single = found(turning(0.9, 0.3, [2.0, -1.0]));
        assert_eq!(turns(&single, "alpha'"), Some([0, -1, 0]));
        assert_eq!(turns(&single, "nu'"), Some([1, 2, 0]));
        assert_eq!(turns(&single, "psi'"), Some([-1, 0, -1]));
        assert_eq!(turns(&single, "gamma'"), Some([0, 2, -1]));
        assert_eq!(symbols(&single), ["alpha'", "gamma'", "nu'"]);
        // L stays outside the cone: n does not circle it, but its fast part does.
        let aside = found(leaning(0.9, 0.3, 0.1, [2.0, 0.0]));
        assert_eq!(turns(&aside, "nu'"), Some([1, 2, 0]));
        // n passes the pole: at a point of the grid, next to one, and with loops on both sides that differ.
        let passing = turning(0.6, 0.6, [0.0, 0.0]);
        let beside = |turns: [f64; 3]| passing(turns.map(|part| part + 0.0137));
        let swinging =
            |turns: [f64; 3]| turning(0.7 + 0.5 * (2.0 * TAU * turns[1] + 0.3).cos(), 0.6, [0.0, 0.0])(turns);
        for through in [found(&passing), found(beside), found(swinging)] {
            assert_eq!((turns(&through, "alpha'"), symbols(&through)), (None, vec!["l'", "nu'", "psi'"]));
        }
    }

    /// A grid of which only `n` is read, at these azimuths.
    fn of_azimuths(count: usize, azimuth: impl Fn(usize, usize) -> f64) -> Grid {
        let state = |k: usize, j: usize| {
            let (sin, cos) = azimuth(k, j).sin_cos();
            let axis = Vector3::new(0.6 * cos, 0.6 * sin, 0.8);
            BodyState { axis, momentum: Vector3::z(), equatorial_axis: Vector3::y() }
        };
        let states = (0..count).flat_map(|k| (0..count).map(move |j| state(k, j))).collect();
        Grid { count, states, third: Vec::new(), means: Vec::new() }
    }

    /// The horizontal part `(cos a + cos b - c, sin a)` of `n` is zero at two points of the torus, in opposite senses, for `c` between 0 and 2, and
    /// nowhere for larger `c`.
    #[test]
    fn four_neighbours_see_the_pole_between_them() {
        let count = 8;
        let angle = |i: usize, zero: f64| TAU * (i as f64 - zero) / count as f64;
        // The poles are at b = 0.64, 0.8 of a step.
        let c = 1.8;
        let with_pole_in = |k: usize, j: usize, part: f64, c: f64| {
            let (k, j) = (k as f64 + 1.0, j as f64 + part);
            of_azimuths(count, move |row, column| {
                let (a, b) = (angle(column, j), angle(row, k));
                a.sin().atan2(a.cos() + b.cos() - c)
            })
        };
        for (k, j) in (0..count).flat_map(|k| (0..count).map(move |j| (k, j))) {
            for part in [0.1, 0.5, 0.9] {
                let is_seen = |c: f64| with_pole_in(k, j, part, c).surrounds_pole();
                assert!(is_seen(c) && !is_seen(2.1), "{k} {j} {part}");
            }
        }
        for [by_k, by_j] in [[1.0, 0.0], [0.0, 1.0], [1.0, 2.0], [-3.0, 1.0], [2.0, 2.0]] {
            let grid = of_azimuths(16, |k, j| TAU * (by_k * k as f64 + by_j * j as f64 + 0.3) / 16.0);
            assert!(!grid.surrounds_pole(), "{by_k} {by_j}");
        }
    }

    /// With `L` on the axis the turn of `n` has no reference plane. With `n` along `L` the turn of `e_x` is counted from a fixed direction, and where
    /// `n` passes that one too, by its sense.
    #[test]
    fn turns_are_counted_where_a_reference_is_missing() {
        let backwards = |state: &dyn Fn([f64; 3]) -> BodyState<f64>, signs: [f64; 3]| {
            found(|turns| state([0, 1, 2].map(|i| signs[i] * turns[i])))
        };
        for sign in [1, -1] {
            let back = f64::from(sign);
            let upright = backwards(&turning(0.0, 0.5, [0.0; 2]), [back, 1.0, 1.0]);
            assert_eq!(turns(&upright, "nu'"), Some([sign, 0, 0]));
            let along = backwards(&turning(0.3, 0.0, [0.0; 2]), [back, 1.0, 1.0]);
            assert_eq!(turns(&along, "psi'"), Some([sign, -1, -1]));
            let passing = backwards(&turning(TAU / 4.0, 0.0, [0.0; 2]), [1.0, 1.0, back]);
            assert_eq!(turns(&passing, "psi'"), Some([0, 0, -sign]));
        }
    }

    /// `n` swings through the pole and `L` through zero: neither has an azimuth, and lines are named by the moving angles of the torus.
    #[test]
    fn lines_without_a_basis_are_named_by_the_angles_of_the_torus() {
        let state = |[a, b, c]: [f64; 3], momentum: f64| {
            let swing = Rotation3::from_euler_angles(0.8 * (TAU * a).sin(), 0.5 * (TAU * b).sin(), TAU * c);
            BodyState {
                axis: swing * Vector3::z(),
                momentum: Vector3::x() * momentum * (TAU * b).cos(),
                equatorial_axis: swing * Vector3::x(),
            }
        };
        let rates = [1.3, 0.01, 0.2];
        let all = found(|turns| state(turns, 1.0));
        assert_eq!((turns(&all, "l'"), turns(&all, "alpha'")), (None, None));
        let named: Vec<_> = all.basis.iter().map(|of| (of.symbol, of.turns)).collect();
        assert_eq!(named, [("theta_1'", [1, 0, 0]), ("theta_2'", [0, 1, 0]), ("theta_3'", [0, 0, 1])]);
        for (of, rate) in all.basis.iter().zip(rates) {
            assert!((of.rate - rate).abs() < 1e-15);
        }
        assert_eq!(all.combination([3, -2, 1]).to_string(), "3 theta_1' - 2 theta_2' + theta_3'");
        let two = rates.map(|rate| DoubleDouble::from(if rate < 0.1 { 0.0 } else { rate / TAU }));
        let two = FundamentalFrequencies::of(|[a, _, c]| state([a, 0.0, c], 0.0), two, &Vector3::z());
        assert_eq!(two.basis.iter().map(|of| of.symbol).collect::<Vec<_>>(), ["theta_1'", "theta_3'"]);
        assert_eq!(two.combination([-1, 0, 4]).to_string(), "-theta_1' + 4 theta_3'");
    }

    #[test]
    fn a_basis_is_completed_by_the_angles_that_do_not_move() {
        let of = |turns| FundamentalFrequency { symbol: "psi'", rate: 1.0, turns };
        assert_eq!(completed(&[of([0, 1, 0])]), Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0));
        assert_eq!(
            completed(&[of([0, 1, 2]), of([0, 0, -1])]),
            Matrix3::new(0.0, 1.0, 2.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0)
        );
        assert_eq!(completed(&[]), Matrix3::identity());
    }

    #[test]
    fn every_line_is_a_combination_of_the_basis() {
        for found in [found(turning(0.3, 0.9, [0.0, 0.0])), found(turning(0.9, 0.3, [2.0, -1.0]))] {
            for multiples in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [3, -2, 1], [-1, 5, 0]] {
                let combination = found.combination(multiples);
                for (angle, multiple) in multiples.into_iter().enumerate() {
                    let sum: i32 = found.basis.iter().map(|of| combination.multiple(of.symbol) * of.turns[angle]).sum();
                    assert_eq!(sum, multiple, "{combination}");
                }
            }
        }
    }
}
