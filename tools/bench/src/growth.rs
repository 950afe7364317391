//! Growth of errors over long motions: energy, K and phase.

use nalgebra::Vector3;
use twofold::dynamics::first_integrals::first_integrals;
use twofold::dynamics::{AxisState, RotationState};
use twofold::propagation::Motion;

use super::Effort;
use super::scene::{BenchScene, rows};
use twofold::numerics::straight_line::{Slope, order};
use twofold_verify::check::largest;
use twofold_verify::double_double::DoubleDouble;

/// A method for long spans, which continues from one segment to the next.
#[derive(Clone, Copy)]
pub struct LongMethod {
    /// Name.
    pub name: &'static str,
    /// The state after a duration.
    pub advance: Advance,
}

/// A function from a state of a scene to the state after a duration.
pub type Advance = fn(&BenchScene, &AxisState<f64>, f64) -> Result<AxisState<f64>, String>;

/// All methods; each takes one line.
pub const METHODS: &[LongMethod] =
    &[LongMethod { name: "Taylor", advance: taylor }, LongMethod { name: "splitting", advance: splitting }];

fn splitting(scene: &BenchScene, state: &AxisState<f64>, duration: f64) -> Result<AxisState<f64>, String> {
    let problem = scene.problem.reduced().starting_from(*state)?;
    Ok(problem.splitting((0.0, duration), 1e-14)?.state(duration)?)
}

fn taylor(scene: &BenchScene, state: &AxisState<f64>, duration: f64) -> Result<AxisState<f64>, String> {
    let problem = scene.problem.reduced().starting_from(*state)?;
    Ok(problem.taylor((0.0, duration), 1e-16)?.state(duration)?)
}

/// Length of a segment (t_c).
const SEGMENT: f64 = 1000.0;

/// Errors of a method at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Name of the method.
    pub method: &'static str,
    /// The time (t_c).
    pub time: f64,
    /// Largest change of the energy at the ends of the segments so far, relative to the sum of the magnitudes of its terms.
    pub energy: f64,
    /// The same for the third integral K.
    pub clebsch: f64,
    /// Largest error of a component of `n`: the phase.
    pub phase: f64,
}

/// Reference states of tp-II: times and `n`.
pub fn references() -> Vec<(f64, Vector3<DoubleDouble>)> {
    let rows = rows(include_str!("../data/long.csv")).into_iter();
    // Each component is the sum of two doubles, each the double nearest to its decimals.
    let component = |v: &[DoubleDouble], i: usize| DoubleDouble::sum_of(v[i].high(), v[i + 1].high());
    let row = |v: Vec<DoubleDouble>| (v[0].high(), Vector3::new(component(&v, 1), component(&v, 3), component(&v, 5)));
    rows.map(|(_, v)| row(v)).collect()
}

/// Errors of every method along tp-II, at every power of ten from 100 t_c to the longest time; `done` receives the fraction of the work that is over.
pub fn measure(effort: &Effort, mut done: impl FnMut(f64)) -> Result<Vec<Row>, String> {
    let scene = BenchScene::named("tp-II");
    let start = integrals(&scene, &scene.problem.initial().axis_state());
    let scale = scales(&scene);
    let mut measured = Vec::new();
    for (i, method) in METHODS.iter().enumerate() {
        let (mut state, mut time, mut drift) = (scene.problem.initial().axis_state(), 0.0, [0.0; 2]);
        for (end, axis) in references().into_iter().filter(|(end, _)| *end <= effort.longest) {
            while time < end {
                let step = SEGMENT.min(end - time);
                state = (method.advance)(&scene, &state, step)?;
                time += step;
                let now = integrals(&scene, &state);
                drift = [0, 1].map(|k| largest([drift[k], (now[k] - start[k]).high().abs() / scale[k]]));
                done((i as f64 + time / effort.longest) / METHODS.len() as f64);
            }
            let lifted = state.axis.map(twofold::Scalar::from_f64);
            let phase = largest((lifted - axis).iter().map(|x: &DoubleDouble| x.high().abs()));
            measured.push(Row { method: method.name, time, energy: drift[0], clebsch: drift[1], phase });
        }
    }
    Ok(measured)
}

/// Energy and K in double-double numbers: doubles would add their own rounding.
fn integrals(scene: &BenchScene, state: &AxisState<f64>) -> [DoubleDouble; 2] {
    let lift = <DoubleDouble as twofold::Scalar>::from_f64;
    let lifted = scene.problem.map(lift);
    let state = AxisState { axis: state.axis.map(lift), momentum: state.momentum.map(lift) };
    let found = first_integrals(lifted.spheroid(), lifted.coefficients(), &state);
    [found.energy, found.clebsch]
}

/// Sums of the magnitudes of the terms of energy and K.
fn scales(scene: &BenchScene) -> [f64; 2] {
    let (initial, s) = (scene.problem.initial(), scene.problem.coefficients());
    let adjugate = twofold::dynamics::first_integrals::symmetric_adjugate(s).abs();
    let (n, l, s) = (initial.axis.abs(), initial.momentum.abs(), s.abs());
    [l.dot(&l) / 2.0 + n.dot(&(s * n)), l.dot(&(s * l)) + 2.0 * n.dot(&(adjugate * n))]
}

/// The exponent `p` of `error ~ time^p` by least squares, from 1,000 t_c on: a random walk shows its exponent only after some time.
pub fn exponent(rows: &[Row], method: &str, error: impl Fn(&Row) -> f64) -> Option<Slope> {
    let of_this = rows.iter().filter(|row| row.method == method && row.time >= 1e3);
    order(&of_this.map(|row| (row.time, error(row))).collect::<Vec<_>>(), 0.0).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use twofold::propagation::TorusMotion;

    #[test]
    fn the_exponent_of_a_power_is_found() {
        let row = |time: f64| Row { method: "m", time, energy: 3e-16 * time.powf(0.5), clebsch: 1.0, phase: time };
        let mut rows: Vec<_> = [1e3, 1e4, 1e5].map(row).into();
        // Rows before 1,000 t_c are not used: this one would flatten both slopes.
        rows.insert(0, Row { energy: 1.0, phase: 1e5, ..row(1e2) });
        assert!((exponent(&rows, "m", |row| row.energy).expect("points").value - 0.5).abs() < 1e-12);
        assert!((exponent(&rows, "m", |row| row.phase).expect("points").value - 1.0).abs() < 1e-12);
        assert_eq!(exponent(&rows, "other", |row| row.phase), None);
    }

    /// Changes are relative to the sum of the magnitudes of the terms. This sum is at least as large as each term, although s has
    /// eigenvalues of either sign.
    #[test]
    fn scales_do_not_cancel() {
        for scene in BenchScene::all() {
            let problem = &scene.problem;
            let (momentum, axis) = (problem.initial().momentum, problem.initial().axis);
            let of_energy = scales(&scene)[0];
            // At least the rotation, and what s gives a single component of n.
            let (least, one) = (momentum.norm_squared() / 2.0, axis.x * axis.x * problem.coefficients().m11.abs());
            assert!(of_energy >= (least + one) * (1.0 - 1e-15), "{}: {of_energy}", scene.name);
            let of_k = scales(&scene)[1];
            let largest =
                (0..3).map(|i| momentum[i].powi(2) * problem.coefficients()[(i, i)].abs()).fold(0.0, f64::max);
            assert!(of_k >= largest * (1.0 - 1e-15), "{}: {of_k}", scene.name);
        }
    }

    /// The largest changes of the integrals so far do not decrease with time. The longest time has a row.
    #[test]
    fn changes_are_the_largest_so_far() {
        let rows = measure(&Effort { rounds: 1, longest: 1e4 }, |_| ()).expect("motions");
        let times: Vec<_> = rows.iter().map(|row| row.time).collect();
        assert_eq!(times, [1e2, 1e3, 1e4].repeat(METHODS.len()));
        let mut compared = 0;
        for (earlier, later) in rows.iter().zip(&rows[1..]).filter(|(earlier, later)| earlier.method == later.method) {
            assert!(
                earlier.time < later.time && earlier.energy > 0.0 && later.clebsch < 1e-10,
                "{earlier:?} {later:?}"
            );
            assert!(later.energy >= earlier.energy && later.clebsch >= earlier.clebsch, "{earlier:?} {later:?}");
            compared += 1;
        }
        assert!(compared >= METHODS.len(), "{compared}");
    }

    /// The series on the torus against 1e7 t_c of motion in double-double numbers, both from a unit vector `n`.
    #[test]
    fn the_exact_motion_is_right_after_ten_million() {
        let problem = BenchScene::named("tp-II").problem;
        let motion = TorusMotion::new(&problem, (0.0, 1e7), 1e-15).expect("a torus");
        for (t, axis) in references() {
            let found = motion.axis_state(t).expect("a state").axis.map(twofold::Scalar::from_f64);
            let error = largest((found - axis).iter().map(|x: &DoubleDouble| x.high().abs()));
            assert!(error < 2e-15, "t = {t}: {error:e}");
        }
    }

    /// The reference of fifty digits takes `n` as it is rounded: a torque of `2 C |s|` that is larger by `|n|^2 - 1` may turn the axes by so much more.
    #[test]
    fn the_long_reference_agrees_with_that_of_fifty_digits() {
        let scene = BenchScene::named("tp-II");
        let problem = &scene.problem;
        let axis = problem.initial().axis.map(<DoubleDouble as twofold::Scalar>::from_f64);
        let excess = (axis.dot(&axis) - twofold::Scalar::from_f64(1.0)).high().abs();
        let torque =
            2.0 * problem.spheroid().constant_c * problem.coefficients().amax() / problem.initial().momentum.norm();
        let mut compared = 0;
        for (t, axis) in references() {
            if let Some((_, state)) = scene.references.iter().find(|(time, _)| *time == t) {
                let error = largest((state.axis - axis).iter().map(|x| x.high().abs()));
                assert!(error < excess * (1.0 + torque * t), "t = {t}: {error:e}, {excess:e}");
                compared += 1;
            }
        }
        assert!(compared > 0);
    }
}
