//! Verner's Runge-Kutta 9(8) of the crate `numeris`, end state only: the baseline.

use nalgebra::Vector3;
use numeris::Vector;
use numeris::ode::{RKAdaptive, RKV98NoInterp};
use twofold::dynamics::BodyState;
use twofold::dynamics::equations_of_motion::{body_state_rates, reduced_rates};
use twofold_verify::second_integrator::settings;

use super::method::End;
use super::scene::BenchScene;

fn vector<const N: usize>(y: &Vector<f64, N>, k: usize) -> Vector3<f64> {
    Vector3::new(y[3 * k], y[3 * k + 1], y[3 * k + 2])
}

pub(super) fn axis(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let (problem, initial) = (&scene.problem, scene.problem.initial());
    let pack = |n: &Vector3<f64>, l: &Vector3<f64>| Vector::from_array([n.x, n.y, n.z, l.x, l.y, l.z]);
    let rates = |_: f64, y: &Vector<f64, 6>| {
        let (n, l) = reduced_rates(problem.spheroid(), problem.coefficients(), &vector(y, 0), &vector(y, 1));
        pack(&n, &l)
    };
    let start = pack(&initial.axis, &initial.momentum);
    let end =
        RKV98NoInterp::integrate(0.0, duration, &start, rates, &settings(tolerance)).map_err(|e| e.to_string())?;
    let (axis, momentum) = (vector(&end.y, 0), vector(&end.y, 1));
    Ok(End { axis, momentum, equatorial_axis: None, steps: end.accepted + end.rejected, evaluations: end.evals })
}

pub(super) fn orientation(scene: &BenchScene, duration: f64, tolerance: f64) -> Result<End, String> {
    let problem = &scene.problem;
    let pack = |state: &BodyState<f64>| {
        let mut packed = [0.0; 9];
        for (k, v) in [&state.axis, &state.momentum, &state.equatorial_axis].into_iter().enumerate() {
            packed[3 * k..3 * k + 3].copy_from_slice(v.as_slice());
        }
        Vector::from_array(packed)
    };
    let unpack =
        |y: &Vector<f64, 9>| BodyState { axis: vector(y, 0), momentum: vector(y, 1), equatorial_axis: vector(y, 2) };
    let rates =
        |_: f64, y: &Vector<f64, 9>| pack(&body_state_rates(problem.spheroid(), problem.coefficients(), &unpack(y)));
    let start = pack(problem.initial());
    let end =
        RKV98NoInterp::integrate(0.0, duration, &start, rates, &settings(tolerance)).map_err(|e| e.to_string())?;
    let BodyState { axis, momentum, equatorial_axis } = unpack(&end.y);
    let (steps, equatorial_axis) = (end.accepted + end.rejected, Some(equatorial_axis));
    Ok(End { axis, momentum, equatorial_axis, steps, evaluations: end.evals })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each step has sixteen stages, whether it is accepted or not; the choice of the first takes less than sixteen evaluations.
    #[test]
    fn steps_that_are_rejected_count() {
        for scene in BenchScene::all() {
            for tolerance in [1e-3, 1e-5, 1e-8, 1e-11] {
                for run in [axis, orientation] {
                    let end = run(&scene, 100.0, tolerance).expect("a motion");
                    assert_eq!(end.steps, end.evaluations / 16, "{}, {tolerance:e}", scene.name);
                }
            }
        }
    }
}
