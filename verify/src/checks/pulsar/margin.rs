//! Time derivatives of `m.n` along motions, and their bounds. Eq. (44).

use crate::prelude::*;
use num_dual::Dual3_64;
use twofold::observables::pulsar::rate_bounds::{RateBounds, rate_bounds};

checks! {
    /// the first three time derivatives of m.n are those of the dense output, differentiated by duals
    Autodiff "beam-margin-rates" [44]: rates_by_duals;
    AtMost(64.0) "largest error / (2.2e-16, bound on that derivative), 40 random motions, the third divided by 22/3";
    because "differentiating a series of order 22 k times multiplies its rounding by up to (22/3)^k, 54 for the second; the state adds a few";
    /// the first three time derivatives of m.n stay below the bounds from energy and spin at the start
    Property "beam-margin-bounds" [44]:
        || along_motions(false, |bounds, _, duals| largest([1, 2, 3].map(|k| duals[k].abs() / bounds[k - 1])));
    AtMost(1.0) "largest derivative / its bound, 40 random motions";
    because "the definition of a bound";
    /// so do those of a star whose deformation is all bulge, of which the averaged motion is exact, and they are those of that motion differentiated
    /// by duals
    Autodiff "beam-margin-bulge" [44]: with_bulge;
    AtMost(1.0) "largest derivative / its bound, and largest error / (1e-12, bound on that derivative), 40 random motions";
    because "the definition of a bound; three derivatives multiply the rounding 1e-15 of a phase of up to 40 rad and of elliptic functions by some tens";
    /// the fourth and the sixth time derivative of m.n also stay below their bounds, by their mean values: the first and third divided differences
    /// of the third derivative
    Property "beam-margin-high-bounds" [44]: high_rates_within_bounds;
    AtMost(1.0) "largest mean value / its bound, 40 random motions without and with a bulge, steps of 0.04 units of time";
    because "a bound of a derivative bounds its mean values; rounding of a third difference is 1e-11";
}

fn rates_by_duals() -> Result<Measured, String> {
    along_motions(false, |bounds, kernel, duals| {
        let scale = [1.0, 1.0, 22.0 / 3.0];
        largest([1, 2, 3].map(|k| (kernel[k] - duals[k]).abs() / (bounds[k - 1] * scale[k - 1] * f64::EPSILON)))
    })
}

fn with_bulge() -> Result<Measured, String> {
    along_motions(true, |bounds, kernel, duals| {
        largest([1, 2, 3].map(|k| {
            let [bound, off] = [bounds[k - 1], (kernel[k] - duals[k]).abs()];
            largest([duals[k].abs() / bound, off / (bound * 1e-12)])
        }))
    })
}

fn high_rates_within_bounds() -> Result<Measured, String> {
    const STEP: f64 = 0.04;
    worst_of([false, true], |&bulge| {
        worst_over(45, 40, &scenes(), |scene| {
            let problem = problem_of(scene, bulge)?;
            let bounds = bounds_of(&problem);
            let state = states(&problem, 1e-15)?;
            let (beam, observer) = beam_and_observer(scene);
            let third = |i: u32| {
                let state = state(STEP * f64::from(i))?;
                Ok::<_, String>(margin_rates(&beam, &problem, &state, &observer)[3])
            };
            let thirds = (0..500).map(third).collect::<Result<Vec<_>, _>>()?;
            let fourth = largest(thirds.windows(2).map(|f| (f[1] - f[0]).abs())) / STEP;
            let sixth = largest(thirds.windows(4).map(|f| (f[3] - f[0] - 3.0 * (f[2] - f[1])).abs())) / STEP.powi(3);
            Ok(largest([fourth / bounds.fourth, sixth / bounds.sixth]))
        })
    })
}

/// The problem of a scene, or with a bulge in place of its rigid deformation.
fn problem_of(scene: &RandomScene, bulge: bool) -> Result<Problem<f64>, Error> {
    let problem = scene.problem();
    if !bulge {
        return Ok(problem);
    }
    let body = RigidSpheroid { constant_c: 0.0, ..*problem.spheroid() };
    Problem::new(body, *problem.coefficients(), *problem.initial())?.with_bulge(0.4)
}

/// States by time.
type States<S> = Box<dyn Fn(S) -> Result<BodyState<S>, Error>>;

/// States over 20 units of time: by Taylor series, or of the averaged motion, which is exact for a bulge alone.
fn states<S: Real>(problem: &Problem<S>, tolerance: f64) -> Result<States<S>, Error> {
    if problem.bulge().re() == 0.0 {
        let motion = problem.taylor((0.0, 20.0), tolerance)?;
        return Ok(Box::new(move |t| motion.state(t)));
    }
    let motion = AveragedSolution::new(problem, AveragingOrder::Second)?;
    Ok(Box::new(move |t| Ok(motion.state(t))))
}

fn bounds_of(problem: &Problem<f64>) -> RateBounds {
    rate_bounds(problem.spheroid(), problem.coefficients(), problem.bulge(), problem.initial())
}

fn margin_rates(beam: &Beam<f64>, problem: &Problem<f64>, state: &BodyState<f64>, observer: &Vector3<f64>) -> [f64; 4] {
    beam.margin_rates(problem.spheroid(), problem.coefficients(), problem.bulge(), state, observer)
}

/// A beam and a line of sight from the numbers of a scene.
fn beam_and_observer(scene: &RandomScene) -> (Beam<f64>, Vector3<f64>) {
    let EulerAngles { alpha: chi, beta: theta, gamma: azimuth } = scene.angles;
    (Beam::new(chi, azimuth, 0.7), Observer::at(theta, chi).direction)
}

/// The largest figure from the three bounds at the start, the margin and its rates by the kernel, and its first three
/// derivatives by duals, at 25 times of 40 random motions over 20 units of time.
fn along_motions(bulge: bool, figure: fn([f64; 3], [f64; 4], [f64; 4]) -> f64) -> Result<Measured, String> {
    worst_over(44, 40, &scenes(), |scene| Ok(of_motion(scene, bulge, figure)?))
}

fn of_motion(scene: &RandomScene, bulge: bool, figure: fn([f64; 3], [f64; 4], [f64; 4]) -> f64) -> Result<f64, Error> {
    let problem = problem_of(scene, bulge)?;
    let bounds = bounds_of(&problem);
    let state = states(&problem.map(Dual3_64::from), 1e-16)?;
    let (beam, observer) = beam_and_observer(scene);
    let beam_lifted = Beam { axis: beam.axis.map(Dual3_64::from), half_opening: Dual3_64::from(0.7) };
    Ok(largest((0..25).map(|i| {
        let t = 0.3 + 0.8 * f64::from(i);
        let Ok(state) = state(Dual3_64::new(t, 1.0, 0.0, 0.0)) else { return f64::NAN };
        let by_duals = beam_lifted.margin(&state, &observer.map(Dual3_64::from));
        let real = BodyState::from_vectors(state.vectors().map(|vector| vector.map(|x| x.re)));
        let kernel = margin_rates(&beam, &problem, &real, &observer);
        figure(
            [bounds.first, bounds.second, bounds.third],
            kernel,
            [by_duals.re, by_duals.v1, by_duals.v2, by_duals.v3],
        )
    })))
}
