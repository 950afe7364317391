//! Choice of the scheme and the step for a tolerance.

use crate::dynamics::{Problem, RotationState};
use crate::error::Error;
use crate::numerics::fused::detect_fused;
use crate::propagation::input::check_request;
use crate::propagation::splitting::error::expected_rounding;
use crate::propagation::splitting::motion::{PrincipalProblem, SPLITTING_STEP_LIMIT};
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::splitting::schemes::{
    GRADIENT_8_6_4, GRADIENT_8_6_6, GRADIENT_8_8_6, KAHAN_LI_8, NEAR_INTEGRABLE_6_2, NEAR_INTEGRABLE_10_4, SRKN_6B,
    SRKN_14A, STRANG,
};

/// Model of the error of a scheme after rotation by `W T`, in the components of `n` and of `L / I^xx W`:
///
/// ```text
/// W T sum_k constants[k] epsilon^(k+1) (W h)^orders[k],    epsilon = 2 |C| (s_max - s_min) / (I^xx W^2)
/// ```
///
/// with `W` the bound of `|L| / I^xx` from the energy. The constants are quantiles over random motions with `W T = 300` and
/// `epsilon` from 1e-6 to 0.5; the middle half of these motions lies within a factor of ten of the formula.
struct Model {
    scheme: &'static Scheme,
    constants: [f64; 3],
    /// Time of one stage relative to a stage without force gradient.
    stage_cost: f64,
    /// Largest rotation (rad) per stage for which the formula holds.
    largest_turn: f64,
}

const fn model(scheme: &'static Scheme, constants: [f64; 3]) -> Model {
    let stage_cost = if scheme.gradients.is_empty() { 1.0 } else { 1.2 };
    Model { scheme, constants, stage_cost, largest_turn: LARGEST_TURN }
}

impl Model {
    const fn up_to(mut self, turn: f64) -> Self {
        self.largest_turn = turn;
        self
    }
}

static MODELS: [Model; 9] = [
    model(&STRANG, [9.8e-3, 2.0e-2, 3.9e-2]),
    model(&SRKN_6B, [4.8e-7, 9.4e-6, 1.9e-5]).up_to(0.25),
    model(&SRKN_14A, [1.5e-8, 3.8e-8, 7.6e-8]),
    model(&KAHAN_LI_8, [2.5e-8, 1.9e-6, 8.2e-6]),
    model(&NEAR_INTEGRABLE_6_2, [4.0e-6, 7.5e-4, 1.9e-3]),
    model(&NEAR_INTEGRABLE_10_4, [9.6e-11, 4.1e-5, 8.1e-5]).up_to(0.18),
    model(&GRADIENT_8_6_4, [2.3e-8, 1.9e-6, 1.3e-5]),
    model(&GRADIENT_8_6_6, [2.4e-8, 4.5e-7, 1.1e-6]),
    model(&GRADIENT_8_8_6, [1.9e-8, 6.8e-7, 1.6e-6]),
];

/// Ratio of the tolerance to the error predicted by the model: motions differ by that much.
const SAFETY: f64 = 10.0;

/// Largest rotation (rad) per stage: beyond it, higher powers of the step than those of the formula exceed it by more than
/// [`SAFETY`] for one random motion in a hundred.
const LARGEST_TURN: f64 = 0.3;

impl Model {
    fn error(&self, epsilon: f64, turn: f64, step: f64) -> f64 {
        let orders = self.scheme.orders;
        turn * (0..3).map(|k| self.constants[k] * epsilon.powi(k as i32 + 1) * step.powi(orders[k] as i32)).sum::<f64>()
    }

    /// Error of a derivative with respect to `epsilon`, divided by the angle by which the derivative itself grows: the slope of
    /// [`error`](Self::error) divided by the rotation angle. It does not vanish with `epsilon`. Over few turns it is larger, because
    /// oscillating terms have not averaged out.
    fn error_of_derivative(&self, epsilon: f64, step: f64) -> f64 {
        let orders = self.scheme.orders;
        (0..3).map(|k| (k + 1) as f64 * self.constants[k] * epsilon.powi(k as i32) * step.powi(orders[k] as i32)).sum()
    }

    /// Largest step, as an angle (rad), that is accurate enough; errors increase with the step.
    fn longest(&self, is_good: impl Fn(f64) -> bool) -> f64 {
        let largest = self.largest_turn * self.scheme.stages() as f64;
        if is_good(largest) {
            return largest;
        }
        let (mut low, mut high) = (0.0, largest);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if is_good(middle) { low = middle } else { high = middle }
        }
        low
    }

    /// Time of one step relative to a stage without force gradient.
    fn step_cost(&self) -> f64 {
        self.stage_cost * self.scheme.stages() as f64
    }

    fn cost_per_angle(&self, step: f64) -> f64 {
        self.step_cost() / step
    }
}

/// The quantity whose error determines the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Goal {
    /// The state.
    State,
    /// The state with its derivatives with respect to parameters. They cost several times as much as the motion, so the steps are chosen for
    /// the error of the model itself, which more motions exceed.
    Derivatives,
}

impl Goal {
    /// The error that is compared with the tolerance.
    fn error(self, model: &Model, epsilon: f64, turn: f64, step: f64) -> f64 {
        let error = model.error(epsilon, turn, step);
        match self {
            Self::State => SAFETY * error,
            Self::Derivatives => error.max(SAFETY * model.error_of_derivative(epsilon, step)),
        }
    }

    /// Largest step, as an angle (rad), for which this error is within the tolerance.
    fn step(self, model: &Model, epsilon: f64, turn: f64, tolerance: f64) -> f64 {
        model.longest(|step| self.error(model, epsilon, turn, step) <= tolerance)
    }

    /// Fraction of random motions whose error stays below the tolerance: for the state and for derivatives, 0.6 % and 3.5 % of 10,000 motions with
    /// strong torques were above, and 0.5 % and 0.9 % of 3,000 of every kind (`docs/plans.md`).
    fn coverage(self) -> f64 {
        match self {
            Self::State => 0.99,
            Self::Derivatives => 0.95,
        }
    }
}

/// Prediction for [`Problem::splitting`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplittingForecast {
    /// The cheapest scheme according to the model.
    pub scheme: &'static Scheme,
    /// Length of its steps, in the unit of time of the scene.
    pub step: f64,
    /// Number of its steps.
    pub steps: f64,
    /// Error at the end, excluding rounding: a multiple of the model's error for these steps, which the fraction [`coverage`](Self::coverage) of
    /// random motions stays below. Zero without torque, where the flows are exact.
    pub truncation: f64,
    /// Fraction of random motions whose error stays below `truncation`.
    pub coverage: f64,
    /// The rounding error that [`error_estimate`](crate::propagation::Motion::error_estimate) will report at the end, without
    /// its growth by an instability.
    pub rounding: f64,
}

impl<X: RotationState<f64>> Problem<f64, X> {
    /// The scheme and the step that a model of cost and error chooses for [`splitting`](Self::splitting).
    ///
    /// # Errors
    /// As for [`splitting`](Self::splitting).
    pub fn splitting_forecast(&self, span: (f64, f64), tolerance: f64) -> Result<SplittingForecast, Error> {
        self.splitting_forecast_for(Goal::State, span, tolerance)
    }

    /// As [`splitting_forecast`](Self::splitting_forecast), for a given goal.
    ///
    /// # Errors
    /// As for [`splitting_forecast`](Self::splitting_forecast), and for derivatives on a processor without the instructions for tangent maps.
    pub(crate) fn splitting_forecast_for(
        &self,
        goal: Goal,
        span: (f64, f64),
        tolerance: f64,
    ) -> Result<SplittingForecast, Error> {
        if goal == Goal::Derivatives {
            require_tangent_maps()?;
        }
        check_request(span, tolerance)?;
        let forecast = cheapest(&PrincipalProblem::<2>::new(self)?, span, tolerance, goal);
        Error::ensure(forecast.steps <= SPLITTING_STEP_LIMIT, "number of steps", forecast.steps, "at most 1e10")?;
        Ok(forecast)
    }
}

/// Number of parameters whose tangent maps are carried along with one motion: four registers of four doubles.
pub(crate) const TANGENTS_AT_ONCE: usize = 16;

/// Refuses derivatives on a processor without the instructions for tangent maps.
///
/// # Errors
/// [`Error::Unsupported`] there.
pub(crate) fn require_tangent_maps() -> Result<(), Error> {
    let refused = Error::Unsupported { what: "derivatives by splitting", why: "the processor lacks AVX2 and FMA" };
    if detect_fused().is_some() { Ok(()) } else { Err(refused) }
}

/// The scheme with the lowest cost at its largest step for the goal.
pub(super) fn cheapest<const V: usize>(
    scene: &PrincipalProblem<V>,
    span: (f64, f64),
    tolerance: f64,
    goal: Goal,
) -> SplittingForecast {
    let (rate, duration) = (scene.largest_rate, (span.1 - span.0).abs());
    let epsilon = if rate > 0.0 { scene.spread / rate.powi(2) } else { 0.0 };
    let turn = rate * duration;
    let steps = MODELS.iter().map(|model| (model, goal.step(model, epsilon, turn, tolerance)));
    let best = steps.min_by(|(a, x), (b, y)| a.cost_per_angle(*x).total_cmp(&b.cost_per_angle(*y)));
    let (model, step) = best.expect("the list of models is not empty");
    let step = if rate > 0.0 { step / rate } else { duration.max(1.0) };
    let steps = (duration / step).ceil().max(1.0);
    SplittingForecast {
        scheme: model.scheme,
        step,
        steps,
        truncation: goal.error(model, epsilon, turn, turn / steps),
        coverage: goal.coverage(),
        rounding: expected_rounding(turn),
    }
}

/// Prediction for computing the samples of a motion by splitting.
#[cfg(target_arch = "x86_64")]
pub(super) struct SampledForecast {
    pub(super) scheme: &'static Scheme,
    /// Largest step.
    pub(super) step: f64,
    /// Number of steps, such that every sample is at the end of one.
    pub(super) steps: u64,
}

/// Smallest tolerance over the rotation angle (rad) at which truncation, not rounding, dominates the error of splitting.
#[cfg(target_arch = "x86_64")]
const LEAST_TOLERANCE_PER_ANGLE: f64 = 1e-16;

/// Largest number of stages per radian at which splitting takes less time than series.
#[cfg(target_arch = "x86_64")]
const MOST_STAGES_PER_ANGLE: f64 = 150.0;

/// The cheapest scheme and step for samples at `times`; `None` if a Taylor series is better.
#[cfg(target_arch = "x86_64")]
pub(super) fn sampled_forecast<const V: usize>(
    scene: &PrincipalProblem<V>,
    start: f64,
    times: &[f64],
    tolerance: f64,
) -> Option<SampledForecast> {
    let duration = (times.last()? - start).abs();
    let rate = scene.largest_rate;
    let turn = rate * duration;
    let moves = turn > 0.0 && turn.is_finite();
    if !moves || tolerance < LEAST_TOLERANCE_PER_ANGLE * turn {
        return None;
    }
    let epsilon = scene.spread / rate.powi(2);
    let cut = |step: f64| {
        let mut before = start;
        let mut steps = 0.0;
        for &time in times {
            steps += ((time - before).abs() / step).ceil();
            before = time;
        }
        steps
    };
    let candidates = MODELS.iter().map(|model| {
        let step = Goal::State.step(model, epsilon, turn, tolerance) / rate;
        let steps = cut(step);
        (model, step, steps, model.step_cost() * steps)
    });
    let (model, step, steps, cost) = candidates.min_by(|a, b| a.3.total_cmp(&b.3))?;
    let worth = step > 0.0 && cost <= MOST_STAGES_PER_ANGLE * turn && steps <= SPLITTING_STEP_LIMIT;
    worth.then_some(SampledForecast { scheme: model.scheme, step, steps: steps as u64 })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::AxisState;
    use crate::dynamics::fixture::{STAR, tensor};
    use nalgebra::Matrix3;

    #[test]
    fn the_error_of_a_derivative_is_the_slope_of_the_error() {
        for model in &MODELS {
            for (epsilon, step) in [(0.3, 1.1), (0.02, 0.4), (1.5, 2.0)] {
                let turn = 70.0;
                let h = 1e-5 * epsilon;
                let slope = (model.error(epsilon + h, turn, step) - model.error(epsilon - h, turn, step)) / (2.0 * h);
                assert_relative_eq!(model.error_of_derivative(epsilon, step), slope / turn, max_relative = 1e-8);
            }
        }
    }

    /// A body that rotates at most at `rate`, with the torque contributing the fraction `epsilon` of its square.
    fn scene(rate: f64, epsilon: f64) -> PrincipalProblem<2> {
        let difference = epsilon * rate * rate * 1.3 / (2.0 * 0.7);
        let s = tensor([0.5 * difference, 0.1 * difference, -0.5 * difference]);
        let momentum = Vector3::y() * (1.3 * rate * (1.0 - epsilon).sqrt());
        let start = AxisState { axis: Vector3::new(0.6, 0.0, 0.8), momentum };
        PrincipalProblem::new(&Problem::new(STAR, s, start).unwrap()).unwrap()
    }

    #[test]
    fn the_longest_step_is_found_to_forty_halvings() {
        let model = Model { scheme: &STRANG, constants: [0.0; 3], stage_cost: 1.0, largest_turn: 0.25 };
        let unit = 0.25 / 2f64.powi(40);
        assert_eq!(model.longest(|step| step <= 0.025), (0.025 / unit).floor() * unit);
    }

    #[test]
    fn fewer_derivatives_than_states_meet_the_tolerance() {
        let coverage = |goal| cheapest(&scene(1.0, 0.01), (0.0, 10.0), 1e-9, goal).coverage;
        assert_eq!([coverage(Goal::State), coverage(Goal::Derivatives)], [0.99, 0.95]);
    }

    #[test]
    fn a_body_at_rest_takes_one_step() {
        for (duration, step) in [(5.0, 5.0), (0.25, 1.0)] {
            let at_rest = cheapest(&scene(0.0, 0.0), (3.0, 3.0 + duration), 1e-5, Goal::State);
            assert_eq!((at_rest.step, at_rest.steps, at_rest.truncation), (step, 1.0, 0.0));
        }
    }

    #[test]
    fn without_torque_a_stage_turns_by_three_tenths_up_to_the_limit_of_steps() {
        let initial = AxisState { axis: Vector3::x(), momentum: Vector3::z() * 0.65 };
        let problem = Problem::new(STAR, Matrix3::zeros(), initial).unwrap();
        let forecast = |duration| problem.splitting_forecast((0.0, duration), 1e-2);
        let short = forecast(10.0).unwrap();
        assert_relative_eq!(0.5 * short.step, 0.3 * short.scheme.stages() as f64, max_relative = 1e-12);
        assert_relative_eq!(forecast(0.9e10 * short.step).unwrap().steps, 0.9e10, max_relative = 1e-9);
        let Err(Error::Domain { quantity, value, .. }) = forecast(1.1e10 * short.step) else { panic!("not refused") };
        assert_eq!(quantity, "number of steps");
        assert_relative_eq!(value, 1.1e10, max_relative = 1e-9);
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn samples_are_reached_by_splitting_within_150_stages_a_radian() {
        // Each sample takes one step of one stage.
        let steps = |samples: usize| {
            let times: Vec<f64> = (1..=samples).map(|k| 3.0 - 0.5 * k as f64 / samples as f64).collect();
            sampled_forecast(&scene(4.0, 1e-9), 3.0, &times, 1e-2).map(|forecast| forecast.steps)
        };
        assert_eq!((steps(299), steps(301)), (Some(299), None));
        // A single sample is reached with the scheme and the step of a motion up to that time.
        for (epsilon, tolerance) in [(0.1, 1e-6), (0.01, 1e-9), (1e-4, 1e-11)] {
            let scene = scene(4.0, epsilon);
            let found = sampled_forecast(&scene, 3.0, &[53.0], tolerance).unwrap();
            let motion = cheapest(&scene, (3.0, 53.0), tolerance, Goal::State);
            assert_eq!((found.scheme, found.step, found.steps as f64), (motion.scheme, motion.step, motion.steps));
        }
        // Nothing moves, or hardly anything.
        let steps = |scene: PrincipalProblem<2>, times: &[f64]| {
            sampled_forecast(&scene, 3.0, times, 1e-2).map(|found| found.steps)
        };
        assert_eq!(steps(scene(4.0, 1e-9), &[3.0, 3.0]), None);
        assert_eq!(steps(scene(0.0, 0.0), &[5.0]), None);
        assert_eq!(steps(scene(4.0, 1e-9), &[3.02]), Some(1));
        // For a tolerance of 1e-16, half a radian of rotation leaves room for its rounding, but two radians do not.
        let reached = |turn: f64| sampled_forecast(&scene(4.0, 1e-12), 3.0, &[3.0 + turn / 4.0], 1e-16).is_some();
        assert!(reached(0.5) && !reached(2.0));
    }
}
