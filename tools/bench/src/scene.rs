//! The scenes that are timed, with their reference states.

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::{AxisState, BodyState, Problem, RigidSpheroid, RotationState};
use twofold::numerics::scalar::Scalar;

use super::method::End;
use twofold_verify::check::largest;
use twofold_verify::double_double::DoubleDouble;

/// Length of the motions that are timed (t_c); the references end there.
pub const DURATION: f64 = 1000.0;

/// A scene: exact initial values, and states of 30 digits at some later times.
#[derive(Debug, Clone)]
pub struct BenchScene {
    /// Name: the paper's four examples, `nearly-free`, `nearly-separatrix`, `strongly-violated`.
    pub name: String,
    /// The body, in units `I^xx = C = 1`, `s^IJ`, which is diagonal, and the state at `t = 0`.
    pub problem: Problem<f64>,
    /// Times (t_c) and states.
    pub references: Vec<(f64, BodyState<DoubleDouble>)>,
}

impl BenchScene {
    /// The seven scenes.
    pub fn all() -> Vec<Self> {
        let states = rows(include_str!("../data/states.csv"));
        let scene = |(name, v): (String, Vec<DoubleDouble>)| {
            let exact: Vec<f64> = v.iter().map(|x| x.high()).collect();
            let vector = |i: usize| Vector3::new(exact[i], exact[i + 1], exact[i + 2]);
            let of_this = states.iter().filter(|(scene, _)| *scene == name);
            Self {
                problem: Problem::new(
                    RigidSpheroid::in_units_of_tc(exact[0]),
                    Matrix3::from_diagonal(&vector(1)),
                    BodyState { axis: vector(4), momentum: vector(7), equatorial_axis: vector(10) },
                )
                .expect("scenes of the benchmark are in range"),
                references: of_this.map(|(_, v)| (v[0].high(), body_state(&v[1..]))).collect(),
                name,
            }
        };
        rows(include_str!("../data/scenes.csv")).into_iter().map(scene).collect()
    }

    /// The scene called `name`.
    pub fn named(name: &str) -> Self {
        let found = Self::all().into_iter().find(|scene| scene.name == name);
        found.unwrap_or_else(|| panic!("no scene is called {name}"))
    }

    /// The problem number `i` of many near this one: its `s` is larger by the fraction `step` times `i`.
    pub fn beside(&self, i: usize, step: f64) -> Problem<f64, AxisState<f64>> {
        let problem = &self.problem;
        let s = problem.coefficients() * (1.0 + step * i as f64);
        Problem::new(*problem.spheroid(), s, problem.initial().axis_state()).expect("a tensor in range")
    }

    /// Largest error of a component of `n`, `L / |L|` and, where it is carried, `e_x` at the time `t` of a reference.
    pub fn error(&self, t: f64, end: &End) -> f64 {
        let reference = self.references.iter().find(|(time, _)| *time == t);
        let (_, reference) = reference.unwrap_or_else(|| panic!("no reference of {} at t = {t}", self.name));
        error(reference, end)
    }
}

/// Largest error of a component of `n`, `L / |L|` and, where it is carried, `e_x`.
pub(super) fn error(reference: &BodyState<DoubleDouble>, end: &End) -> f64 {
    let difference = |ours: &Vector3<f64>, theirs: &Vector3<DoubleDouble>| {
        largest(ours.iter().zip(theirs).map(|(a, b)| (DoubleDouble::from_f64(*a) - *b).high().abs()))
    };
    let momentum = difference(&end.momentum, &reference.momentum) / reference.momentum.map(DoubleDouble::high).norm();
    let turned = end.equatorial_axis.map_or(0.0, |axis| difference(&axis, &reference.equatorial_axis));
    largest([difference(&end.axis, &reference.axis), momentum, turned])
}

/// `n`, `L` and `e_x` from nine numbers.
pub(super) fn body_state(v: &[DoubleDouble]) -> BodyState<DoubleDouble> {
    let vector = |i: usize| Vector3::new(v[i], v[i + 1], v[i + 2]);
    BodyState { axis: vector(0), momentum: vector(3), equatorial_axis: vector(6) }
}

/// Names and numbers of a table.
pub(super) fn rows(text: &str) -> Vec<(String, Vec<DoubleDouble>)> {
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let mut cells = line.split(',');
        let name = cells.next().unwrap_or_default().to_owned();
        (name, cells.map(|cell| cell.parse().expect("reference data are numbers")).collect())
    };
    lines.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_what_their_names_say() {
        let scenes = BenchScene::all();
        let names: Vec<_> = scenes.iter().map(|scene| scene.name.as_str()).collect();
        let expected = ["tp-I", "tp-II", "sp-I", "sp-II", "nearly-free", "nearly-separatrix", "strongly-violated"];
        assert_eq!(names, expected);
        for scene in &scenes {
            assert_eq!(scene.references.last().map(|(t, _)| *t), Some(DURATION), "{}", scene.name);
            let (n, e) = (scene.problem.initial().axis, scene.problem.initial().equatorial_axis);
            assert!(largest([n.norm() - 1.0, e.norm() - 1.0, n.dot(&e)].map(f64::abs)) < 4e-16, "{}", scene.name);
        }
        let of = |name: &str| BenchScene::named(name);
        assert!((1e-7..1e-5).contains(&of("nearly-free").problem.coefficients().norm()));
        assert!(of("strongly-violated").problem.coefficients().norm() > 0.3);
        let direction = of("nearly-separatrix").problem.initial().momentum.normalize();
        assert!((direction.x.hypot(direction.z) - 1e-4).abs() < 1e-10);
        assert_eq!(of("nearly-separatrix").problem.coefficients().m22, 0.01);
    }

    #[test]
    fn an_error_is_seen_where_it_is() {
        let scene = BenchScene::named("tp-I");
        let (t, reference) = scene.references.last().copied().expect("references");
        let [axis, momentum, e_x] =
            [reference.axis, reference.momentum, reference.equatorial_axis].map(|v| v.map(DoubleDouble::high));
        let exact = End { axis, momentum, equatorial_axis: Some(e_x), steps: 0, evaluations: 0 };
        // The reference has more digits than a double: rounded to doubles it is not without error.
        let rounding = scene.error(t, &exact);
        assert!(rounding > 0.0 && rounding < 2.3e-16, "{rounding:e}");
        let wrong = End { equatorial_axis: Some(e_x + Vector3::new(0.0, 1e-9, 0.0)), ..exact };
        assert!((scene.error(t, &wrong) - 1e-9).abs() < 1e-15);
        // L counts as a direction: off by 1e-9 of its length, across and along.
        let off = momentum.x.abs().max(momentum.y.abs()).max(momentum.z.abs()) / momentum.norm();
        let longer = End { momentum: momentum * (1.0 + 1e-9), ..exact };
        assert!((scene.error(t, &longer) / (1e-9 * off) - 1.0).abs() < 1e-5 && (momentum.norm() - 1.0).abs() > 0.01);
        assert!(scene.error(t, &End { momentum: momentum * f64::NAN, ..exact }).is_nan());
    }
}
