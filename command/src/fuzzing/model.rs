//! The public functions of the model with numbers of every kind.

use std::fmt::Debug;
use std::hint::black_box;

use nalgebra::{Matrix3, Vector3};
use twofold::dynamics::first_integrals::first_integrals;
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::epoch::Epoch;
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::{PrincipalCoefficients, principal_frame};
use twofold::numerics::elliptic::carlson::{rc, rd, rf, rj};
use twofold::numerics::elliptic::jacobi::{complete_integral, jacobi};
use twofold::observables::Observer;
use twofold::observables::bound::{SpinAxisDrift, eta_from_inclination, lambda_change};
use twofold::observables::eta_distribution::{EtaDistribution, SpinAxis};
use twofold::observables::pulsar::constant_period::ConstantPeriod;
use twofold::observables::pulsar::width::pulse_width;
use twofold::observables::pulsar::{Beam, PulsarClock, SpinFit, arrivals, pulse_train};
use twofold::observables::spectrum::QuasiPeriodicMotion;
use twofold::plan::{Method, Output, Request};
use twofold::propagation::splitting::SCHEMES;
use twofold::propagation::{
    AveragedMotion, ContinuousAngles, Motion, PhasedMotion, SampledProblem, SymmetricMotion, UniformMotion,
    states_of_many,
};
use twofold::solutions::averaged::slow_precession::slow_precession;
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder, middle_axis_growth};
use twofold::solutions::free::free_precession_rates;
use twofold::solutions::perturbation::{
    Constants, Form, Perturbation, Precession, constants_from_initial_values, shifted_rates,
};
use twofold::solutions::steady::steady_precession_rate;
use twofold::solutions::symmetric::SymmetricSolution;
use twofold::solutions::torus::{separatrix_motion, states_with_integrals};
use twofold::star::maclaurin::MaclaurinSpheroid;
use twofold::star::potential_coefficients::potential_coefficients;
use twofold::star::spheroid_shape::SpheroidShape;
use twofold::star::uniform_spheroid::UniformSpheroid;
use twofold::units::time_unit;

use super::bytes::{Bytes, finite};

/// Rotations (rad) up to which a motion is computed, and beyond which it must be refused immediately.
const LITTLE: f64 = 300.0;
const REFUSED: f64 = 1e13;

/// Number of steps that takes some milliseconds.
const MANY: f64 = 1e4;

/// A scene from bytes, with a span, a tolerance, a beam and an observer.
struct Case {
    body: RigidSpheroid<f64>,
    s: PrincipalCoefficients<f64>,
    tensor: Matrix3<f64>,
    angles: EulerAngles<f64>,
    rates: EulerRates<f64>,
    state: BodyState<f64>,
    span: (f64, f64),
    tolerance: f64,
    beam: Beam<f64>,
    observer: Observer<f64>,
    moderate: bool,
}

impl Case {
    fn new(bytes: &mut Bytes<'_>) -> Self {
        let mut next = || bytes.usual();
        let body = RigidSpheroid {
            inertia_xx: 1.0 + next() * 0.2,
            inertia_zz: 1.0 + next() * 0.2,
            constant_c: 1.0 + next() * 0.2,
        };
        let s = PrincipalCoefficients::new([next() * 0.1, next() * 0.1, next() * 0.1]);
        let angles = EulerAngles { alpha: next(), beta: next(), gamma: next() };
        let rates = EulerRates { alpha: next(), beta: next(), gamma: next() };
        let turn = twofold::euler_angles::body_from_inertial(&EulerAngles { alpha: next(), beta: next(), gamma: 0.0 });
        let state = BodyState::from_angles(&body, &angles, &rates);
        let tensor = turn.transpose() * s.tensor() * turn;
        let span = (next() * 10.0, next() * 10.0);
        let (beam, observer) = (Beam::new(next(), next(), next()), Observer::at(next(), next()));
        let exponent = f64::from(bytes.byte() % 20);
        let (tolerance, moderate) = (10f64.powf(-exponent), bytes.moderate);
        Self { body, s, tensor, angles, rates, state, span, tolerance, beam, observer, moderate }
    }

    /// See [`finite`].
    #[track_caller]
    fn finite<T: Debug>(&self, result: Result<T, twofold::Error>) {
        finite(self.moderate, result);
    }

    fn problem(&self) -> Option<Problem<f64>> {
        Problem::new(self.body, self.tensor, self.state).ok()
    }

    /// Whether a motion is little work, or so much that it must be refused, judged by the rotation of the symmetry axis, which determines the steps.
    fn is_moderate_motion(&self) -> bool {
        let Self { body, state, tensor, span, .. } = self;
        let duration = (span.1 - span.0).abs();
        let turned = state.momentum.norm() / body.inertia_xx.abs() * duration;
        let pulled = (body.constant_c.abs() * tensor.norm() / body.inertia_xx.abs()).sqrt() * 2.0 * duration;
        is_little_or_refused(turned) && is_little_or_refused(pulled)
    }

    /// The same for computations that follow the rotation of the body, which can be much faster.
    fn is_moderate(&self) -> bool {
        let Self { body, state, span, .. } = self;
        let rate = state.momentum.norm() / body.inertia_xx.abs().min(body.inertia_zz.abs());
        self.is_moderate_motion() && is_little_or_refused(rate * (span.1 - span.0).abs())
    }

    fn times(&self) -> [f64; 3] {
        let (from, to) = self.span;
        [from, from + (to - from) * 0.37, to]
    }
}

fn is_little_or_refused(rotation: f64) -> bool {
    rotation.is_nan() || rotation <= LITTLE || rotation >= REFUSED
}

/// A case by the first byte, with numbers from the others. Each ends with a result or an error, and results for moderate numbers are finite.
pub fn model(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    match bytes.byte() % 16 {
        0 => numerical(&Case::new(&mut bytes)),
        1 => by_splitting(&Case::new(&mut bytes), bytes.byte()),
        2 => closed(&Case::new(&mut bytes)),
        3 => planned(&Case::new(&mut bytes), &mut bytes),
        4 => pulses(&Case::new(&mut bytes)),
        5 => clock(&Case::new(&mut bytes), &mut bytes),
        6 => solutions(&Case::new(&mut bytes), &mut bytes),
        7 => torus(&Case::new(&mut bytes), &mut bytes),
        8 => stars(&mut bytes),
        9 => elliptic(&mut bytes),
        10 => bounds(&mut bytes),
        12 => timing(&mut bytes),
        13 => many(&mut bytes),
        11 | 14 => lines(&Case::new(&mut bytes)),
        _ => tensors(&mut bytes),
    }
}

fn numerical(case: &Case) {
    let (Some(problem), Case { span, tolerance, .. }) = (case.problem(), case) else { return };
    case.finite(problem.taylor_forecast(span.1 - span.0, *tolerance));
    if !case.is_moderate() {
        return;
    }
    if let Ok(motion) = problem.taylor(*span, *tolerance) {
        look_within(&motion, case);
    }
    case.finite(problem.taylor_states(span.0, &case.times(), *tolerance));
}

fn look_within<M: Motion<f64, State = BodyState<f64>>>(motion: &M, case: &Case) {
    for time in case.times() {
        case.finite(motion.state(time));
        let _ = black_box(motion.error_estimate(time));
    }
    let _ = black_box(motion.state(f64::NAN));
    if !case.is_moderate() {
        return;
    }
    if let Ok(mut angles) = ContinuousAngles::new(motion, case.span.0, &case.angles) {
        case.finite(angles.at(case.span.1));
    }
}

fn by_splitting(case: &Case, scheme: u8) {
    let (Some(problem), Case { span, tolerance, .. }) = (case.problem(), case) else { return };
    let reduced = problem.reduced();
    let forecast = reduced.splitting_forecast(*span, *tolerance);
    if !case.is_moderate() {
        return;
    }
    // Without a torque steps can be long, and a large rotation takes all the allowed steps: minutes, as predicted.
    if forecast.map_or(true, |forecast| forecast.steps < MANY)
        && let Ok(motion) = reduced.splitting(*span, *tolerance)
    {
        case.finite(motion.state(span.1));
        let _ = black_box(motion.error_estimate(span.1));
    }
    let scheme = SCHEMES[usize::from(scheme) % SCHEMES.len()];
    let step = (span.1 - span.0).abs() / 50.0;
    if let Ok(motion) = problem.splitting_by(scheme, *span, step) {
        look_within(&motion, case);
    }
}

fn closed(case: &Case) {
    let (Some(problem), span) = (case.problem(), case.span) else { return };
    if let Ok(motion) = UniformMotion::steady(&problem, span) {
        look_within(&motion, case);
    }
    if let Ok(motion) = SymmetricMotion::new(&problem, span) {
        look_within(&motion, case);
    }
    if let Ok(motion) = AveragedMotion::new(&problem, span) {
        look_within(&motion, case);
    }
    if let Ok(solution) = AveragedSolution::new(&problem, AveragingOrder::First) {
        case.finite(Ok((solution.state(span.1), solution.error_estimate(span.1))));
    }
}

fn planned(case: &Case, bytes: &mut Bytes<'_>) {
    let (Some(problem), Case { span, tolerance, .. }) = (case.problem(), case) else { return };
    let wanted = bytes.below(1 << 14);
    let outputs: Vec<_> =
        Output::ALL.into_iter().enumerate().filter(|(i, _)| wanted >> i & 1 == 1).map(|(_, o)| o).collect();
    let method = Method::ALL.get(bytes.below(12)).copied();
    let request = Request { method, ..Request::new(&outputs, *span, bytes.below(1000), *tolerance) };
    let Ok(plan) = problem.plan(&request) else { return };
    let _ = black_box(format!("{plan:?}"));
    let is_closed = plan.method.is_some_and(Method::is_closed_form);
    if !is_closed && !case.is_moderate() {
        return;
    }
    if let Ok(motion) = plan.motion(&problem.reduced()) {
        case.finite(motion.state(span.1));
        let _ = black_box(motion.error_estimate(span.1));
    }
    if let Ok(motion) = plan.motion(&problem) {
        case.finite(motion.state(span.1));
        let _ = black_box(motion.error_estimate(span.1));
    }
}

fn pulses(case: &Case) {
    let (Some(problem), Case { span, tolerance, beam, observer, .. }) = (case.problem(), case) else { return };
    if !case.is_moderate() {
        return;
    }
    let sight = observer.direction;
    let Ok(motion) = problem.taylor(*span, *tolerance) else { return };
    if let Ok(train) = pulse_train(&motion, beam, &sight, *span) {
        let _ =
            black_box((train.periods().count(), train.durations().count(), arrivals(&motion, beam, &sight, &train)));
    }
}

fn clock(case: &Case, bytes: &mut Bytes<'_>) {
    let (time, moderate) = (bytes.number(), bytes.moderate);
    let (Some(problem), Case { beam, observer, .. }) = (case.problem(), case) else { return };
    if let Ok(clock) = PhasedMotion::averaged(&problem).and_then(|motion| PulsarClock::new(motion, beam, observer)) {
        case.finite(Ok(clock.period()));
        let _ = black_box(clock.truncation(time));
        for time in [[0.0, 0.0], [time, 0.0], [time, time * 1e-17]] {
            finite(moderate, clock.pulse_near(time));
        }
    }
}

fn solutions(case: &Case, bytes: &mut Bytes<'_>) {
    let (time, moderate) = (bytes.number(), bytes.moderate);
    let Case { body, s, angles, rates, state, .. } = case;
    let spin = rates.gamma;
    let _ = black_box((free_precession_rates(body, spin, angles.beta), shifted_rates(body, s, spin, angles.beta)));
    let constants = Constants { alpha_0: angles.alpha, beta_0: angles.beta, amplitude: rates.alpha, phase: rates.beta };
    for kind in [Precession::Twofold, Precession::Single] {
        finite(moderate, steady_precession_rate(kind, body, s, spin, angles.beta));
        for form in [Form::Printed, Form::Corrected] {
            if let Ok(solution) = Perturbation::new(form, kind, body, s, spin, &constants) {
                finite(moderate, Ok(solution.at(time)));
                finite(moderate, constants_from_initial_values(form, kind, body, s, spin, &solution.at(0.0)));
            }
        }
    }
    let symmetric = PrincipalCoefficients { yy: s.xx, ..*s };
    if let Ok(solution) = SymmetricSolution::new(body, &symmetric, angles, rates) {
        finite(moderate, Ok((solution.angles(time), solution.rates(time), solution.period(), solution.mean_rates())));
    }
    case.finite(slow_precession(body, s, &state.momentum, &state.axis));
    case.finite(middle_axis_growth(body, s, spin, angles.alpha, AveragingOrder::Second));
}

fn torus(case: &Case, bytes: &mut Bytes<'_>) {
    let Case { body, s, state, .. } = case;
    let mut integrals = first_integrals(body, &s.tensor(), state);
    case.finite(states_with_integrals(body, s, &integrals));
    integrals.energy = bytes.number();
    finite(bytes.moderate, states_with_integrals(body, s, &integrals));
    let (energy, spin) = (bytes.number(), bytes.number());
    finite(bytes.moderate, separatrix_motion(body, s, energy, spin));
}

fn stars(bytes: &mut Bytes<'_>) {
    let mut next = || bytes.number();
    let shapes = [
        SpheroidShape::from_eccentricity(next()),
        SpheroidShape::from_eccentricity_squared(next()),
        SpheroidShape::from_axis_ratio(next()),
        SpheroidShape::from_semi_axes(next(), next()),
        SpheroidShape::from_oblateness(next()),
    ];
    for shape in shapes.into_iter().flatten() {
        let _ = black_box(potential_coefficients(&shape));
        for star in [UniformSpheroid::new(next(), next(), shape), UniformSpheroid::from_mass(next(), next(), shape)] {
            let Ok(star) = star else { continue };
            let _ = black_box((star.c(), star.time_unit(), star.polar_inertia_over_c(), star.moment_of_inertia()));
            let _ = black_box(MaclaurinSpheroid::new(star).map(|star| star.pressure(1.0, 1.0)));
        }
    }
    let _ = black_box(time_unit(next()));
    let day = next();
    if let Ok(epoch) = Epoch::new(day as i64, next()) {
        let _ = black_box(epoch.after([next(), next()]).map(|after| after.to_string().parse::<Epoch>()));
    }
}

fn elliptic(bytes: &mut Bytes<'_>) {
    let [x, y, z, p] = std::array::from_fn(|_| bytes.number());
    let _ = black_box((rf(x, y, z), rc(x, y), rd(x, y, z), rj(x, y, z, p)));
    let _ = black_box((complete_integral(x), jacobi(y, z)));
}

fn bounds(bytes: &mut Bytes<'_>) {
    let mut next = || bytes.number();
    let drift =
        SpinAxisDrift { polar_inertia_over_c: next(), spin: next(), interval: next(), cos_lambda_change: next() };
    let _ = black_box((drift.combination_bound(next()), eta_from_inclination(next())));
    let _ = black_box((eta_from_inclination(next()), pulse_width(next(), next(), next())));
    let [a, b, c, d] = std::array::from_fn(|_| next());
    let _ = black_box(lambda_change(a, b, c, d));
    for found in [EtaDistribution::new(a, SpinAxis::AtInclination(b)), EtaDistribution::new(a, SpinAxis::AtConstant(b))]
        .into_iter()
        .flatten()
    {
        let _ = black_box((found.root_mean_square(), found.probability_above(c), found.quantile(d)));
    }
}

fn timing(bytes: &mut Bytes<'_>) {
    let derivatives = usize::from(bytes.byte() % 4);
    let (mut points, mut in_parts) = (Vec::new(), Vec::new());
    while !bytes.is_empty() && points.len() < 40 {
        let number = if bytes.byte() < 200 { points.len() as i64 } else { bytes.number() as i64 };
        let time = bytes.usual();
        points.push((number, time));
        in_parts.push((number, [time, bytes.usual() * 1e-17]));
    }
    finite(bytes.moderate, ConstantPeriod::fit(&points, None));
    finite(bytes.moderate, SpinFit::new(&in_parts, derivatives));
}

fn many(bytes: &mut Bytes<'_>) {
    let cases: Vec<_> = (0..3).map(|_| Case::new(bytes)).filter(Case::is_moderate_motion).collect();
    let times: Vec<_> = cases.iter().map(|case| case.times()).collect();
    let sampled = |(case, times): (&Case, _)| {
        let problem = case.problem()?.reduced();
        Some(SampledProblem { problem, start: case.span.0, times, tolerance: case.tolerance })
    };
    let sampled: Vec<_> = cases.iter().zip(times.iter().map(|times| &times[..])).filter_map(sampled).collect();
    assert_eq!(states_of_many(&sampled).len(), sampled.len());
}

fn lines(case: &Case) {
    let Some(problem) = case.problem() else { return };
    if let Ok(motion) = QuasiPeriodicMotion::new(&problem) {
        case.finite(motion.lines(1e-3, |state| Ok::<_, twofold::Error>([state.equatorial_axis.x, 1.0])));
    }
}

fn tensors(bytes: &mut Bytes<'_>) {
    let entries: [f64; 9] = std::array::from_fn(|_| bytes.number());
    let mut tensor = Matrix3::from_row_slice(&entries);
    finite(bytes.moderate, principal_frame(&tensor));
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        tensor[(j, i)] = tensor[(i, j)];
    }
    if let Ok(frame) = principal_frame(&tensor) {
        let q = frame.principal_from_given;
        assert!((q * q.transpose() - Matrix3::identity()).amax() < 1e-13, "{tensor}");
    }
    let _ = black_box(Vector3::from_row_slice(&entries[..3]));
}
