//! What an observer sees: spin axis, bounds, beams, pulses, position angle, wave harmonics, eta.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;
use twofold::Real;
use twofold::dynamics::BodyState;
use twofold::observables::Observer;
use twofold::observables::bound::{
    SpinAxisDrift, cos_opening_angle, eta_from_inclination, fluid_inertia_over_c, lambda_change, preferred_frame_bound,
    zeta_change_terms,
};
use twofold::observables::eta::{
    mean_squared_speed, root_mean_square_eta, secular_axis_rate, single_precession_start, squared_speed,
    squared_speed_along_motion,
};
use twofold::observables::gravitational_wave::strain_unit;
use twofold::observables::pulsar::beam::{Beam, axis_along_line_of_sight};
use twofold::observables::pulsar::direction::{
    axis_along_line_of_sight_in_azimuth, azimuth_offset_point, cosine_of_colatitude, magnetic_axis_direction,
};
use twofold::observables::pulsar::event_time::event_time;
use twofold::observables::pulsar::period::{
    approximate_period, azimuth_offset_rate, azimuth_rate, instantaneous_period,
};
use twofold::observables::pulsar::position_angle::{
    position_angle, position_angle_rate, rotating_vector_gradient, rotating_vector_point,
    rotating_vector_position_angle,
};
use twofold::observables::pulsar::width::{PulseWidth, cosine_of_half_width, edge_azimuths, pulse_width};
use twofold::observables::spin_axis::{cos_lambda_change, cos_lambda_in_angles, cos_lambda_rate};
use twofold::observables::wave_harmonics::WaveHarmonics;
use twofold::propagation::AxisState;
use twofold::units::geometrised::{KILOGRAM, METRE};
use twofold::units::time_unit;

use super::parts::{angles, body, joined, none, symmetric, vector};
use crate::stability::Input::{self, Above, Fixed, In, Log, Near, Signed};
use crate::stability::oracle::pi;
use crate::stability::{Case, functions};

fn width<S: Real>(width: PulseWidth<S>) -> Vec<S> {
    match width {
        PulseWidth::Pulsed(width) => vec![width],
        PulseWidth::AlwaysOn | PulseWidth::NeverOn => none(1),
    }
}

fn state<S: Real>(x: &[S]) -> BodyState<S> {
    BodyState { axis: vector(x), momentum: vector(&x[3..]), equatorial_axis: vector(&x[6..]) }
}

/// Colatitude and azimuth.
fn on_sphere<S: Real>(x: &[S]) -> Vector3<S> {
    let ((st, ct), (sp, cp)) = (x[0].sin_cos(), x[1].sin_cos());
    Vector3::new(st * cp, st * sp, ct)
}

fn result<S: Real>(value: Result<S, twofold::Error>) -> Vec<S> {
    value.map_or(none(1), |value| vec![value])
}

/// Mean of the squared speed, with constants to 31 digits.
fn speed_along_motion<S: Real>(r: S, alpha: S, beta: S) -> S {
    let (sixth, third) = (S::one() / S::from_f64(6.0), S::one() / S::from_f64(3.0));
    let values = [r / 2.0 - sixth, -(r / 2.0) - sixth, third];
    let ((sa, ca), (sb, cb)) = (alpha.sin_cos(), beta.sin_cos());
    let squares = [sa * sa * sb * sb, ca * ca * sb * sb, cb * cb];
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].re().total_cmp(&values[i].re()));
    let margin = (values[order[1]] - values[order[2]]) * squares[order[2]]
        - (values[order[0]] - values[order[1]]) * squares[order[0]];
    if margin.re() < 0.0 {
        order.reverse();
    }
    let [s1, s2, s3] = order.map(|i| values[i]);
    let [l1, l2, l3] = order.map(|i| squares[i]);
    let first = (s1 - s2) * l2 + (s1 - s3) * l3;
    let last = (s1 - s3) * l1 + (s2 - s3) * l2;
    let middle = (s2 - s3) * l3 - (s1 - s2) * l1;
    let complement = (s1 - s3) * middle / ((s2 - s3) * first);
    let zero = S::zero();
    // R_D and R_F are not differentiable at zero: a number far below the smallest parameter.
    let tiny = zero;
    let mean = rd_at_zero(complement, tiny);
    last * (first - (s1 - s2) * mean) * 4.0
}

/// `<sn^2> = R_D(0, m1, 1) / (3 R_F(0, m1, 1))` by the arithmetic-geometric mean: `(1 - E / K) / m`.
fn rd_at_zero<S: Real>(m1: S, _: S) -> S {
    let (mut a, mut b) = (S::one(), m1.sqrt());
    let m = S::one() - m1;
    // sum 2^(n-1) c_n^2 = 1 - E / K; c_1 = (1 - b) / 2, c_0^2 = m.
    let mut square = m / ((S::one() + b) * (S::one() + b) * 4.0);
    let (mut sum, mut weight) = (S::from_f64(0.5), S::one());
    for _ in 0..60 {
        sum += square * weight;
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
        let next = (a + b) / 2.0;
        square = square * square * m / (next * next * 16.0);
        weight = weight * 2.0;
        if (square * weight).re().abs() < 1e-60 {
            break;
        }
    }
    sum
}

functions! {
    // theta_o, phi_o, alpha, beta
    Lambda(x) { vec![cos_lambda_in_angles(x[0], x[1], x[2], x[3])] }
    LambdaChange(x) { vec![cos_lambda_change(x[0], x[1], (x[2], x[3]), (x[4], x[5]))] }
    LambdaRate(x) { vec![cos_lambda_rate(&body(&x[9..]), &vector(x), &vector(&x[3..]), &vector(&x[6..]))] }
    Drift(x) {
        let drift = SpinAxisDrift { cos_lambda_change: x[0], polar_inertia_over_c: x[1], spin: x[2], interval: x[3] };
        let by_inclination = eta_from_inclination(x[5]).and_then(|eta| drift.combination_bound(eta));
        [result(drift.combination_bound(x[4])), result(by_inclination)].concat()
    }
    EtaFromInclination(x) { result(eta_from_inclination(x[0])) }
    FluidAndPreferred(x) {
        [vec![fluid_inertia_over_c(x[0])], result(preferred_frame_bound(x[0], &vector(&x[1..])))].concat()
    }
    // chi or zeta, the other, width, its change
    Opening(x) { vec![cos_opening_angle(x[1], x[0], x[2])] }
    ZetaChange(x) { let [sine, turning] = zeta_change_terms(x[1], x[0], x[2]);
        vec![sine / turning * x[3]] }
    LambdaFromWidth(x) { result(lambda_change(x[1], x[0], x[2], x[3])) }
    /// With cotangents, Eq. (42) as printed.
    PrintedLambdaFromWidth(x) {
        let ((sl, cl), (sc, cc), (sw, cw)) = (x[1].sin_cos(), x[0].sin_cos(), (x[2] / 2.0).sin_cos());
        vec![sw / (cl / sl * cw + cc / sc) * x[3] / 2.0]
    }
    // chi, delta, rho, state (9), line of sight (3)
    Margin(x) {
        let beam = Beam::new(x[0], x[1], x[2]);
        let state = state(&x[3..]);
        let mut all = joined(&[beam.direction(&state), beam.opposite().axis]);
        all.push(beam.margin(&state, &vector(&x[12..])));
        all
    }
    // rho, chi, delta, s (6), state (9), line of sight (3), body (3)
    MarginRates(x) {
        let beam = Beam::new(x[1], x[2], x[0]);
        beam.margin_rates(&body(&x[21..]), &symmetric(&x[3..]), &state(&x[9..]), &vector(&x[18..])).to_vec()
    }
    // beta, alpha, gamma, chi, delta, theta_o, phi_o
    Along(x) { vec![axis_along_line_of_sight(&angles(&[x[1], x[0], x[2]]), x[3], x[4], x[5], x[6])] }
    // chi, beta, gamma, delta, alpha, rate of gamma
    Direction(x) {
        let (offset_x, offset_y) = azimuth_offset_point(x[1], x[2], x[0], x[3]);
        vec![cosine_of_colatitude(x[1], x[2], x[0], x[3]), offset_x, offset_y]
    }
    DirectionAngles(x) {
        magnetic_axis_direction(&angles(&[x[4], x[1], x[2]]), x[0], x[3]).map_or(none(2), |(theta, phi)| vec![theta, phi])
    }
    /// By the arc cosine, and the quotient of Eq. (50) with `cot chi`.
    NaiveDirectionAngles(x) {
        let ((sb, cb), (sc, cc)) = (x[1].sin_cos(), x[0].sin_cos());
        let (sg, cg) = (x[2] + x[3]).sin_cos();
        let cosine = cb * cc + sb * sc * sg;
        let theta = (S::one() - cosine * cosine).sqrt().atan2(cosine);
        vec![theta, x[4] + (cb * sg - cc / sc * sb).atan2(cg)]
    }
    OffsetRate(x) { vec![azimuth_offset_rate(x[1], x[2], x[5], x[0], x[3])] }
    InAzimuth(x) { vec![axis_along_line_of_sight_in_azimuth(x[1], x[2], x[0], x[3])] }
    // m_x, m_y, m_z, omega
    AzimuthRate(x) { vec![azimuth_rate(&vector(x), &vector(&x[3..]))] }
    // Theta, Phi, omega
    AzimuthRateOnSphere(x) { vec![azimuth_rate(&on_sphere(x), &vector(&x[2..]))] }
    /// Over `1 - m_z^2`.
    NaiveAzimuthRate(x) {
        let (m, omega) = (on_sphere(x), vector(&x[2..]));
        vec![(omega.z - omega.dot(&m) * m.z) / (S::one() - m.z * m.z)]
    }
    Periods(x) { vec![instantaneous_period(x[1]), approximate_period(x[1], x[0])] }
    ExactPeriods(x) {
        let turn = pi::<S>() * 2.0;
        vec![turn / x[1], turn / x[1] * (S::one() - x[0] / x[1])]
    }
    NearPole(x) { width(pulse_width(x[1], x[0], x[2])) }
    PrintedNearPole(x) {
        let cosine = cosine_of_half_width(x[1], x[0], x[2]);
        vec![(S::one() - cosine * cosine).sqrt().atan2(cosine) * 2.0]
    }
    // half opening, colatitudes
    Width(x) { width(pulse_width(x[0], x[1], x[2])) }
    PrintedWidth(x) {
        let cosine = cosine_of_half_width(x[0], x[1], x[2]);
        vec![(S::one() - cosine * cosine).sqrt().atan2(cosine) * 2.0]
    }
    CosineOfHalfWidth(x) { vec![cosine_of_half_width(x[1], x[0], x[2])] }
    Edges(x) { let (first, last) = edge_azimuths(x[0], x[1]); vec![first, last] }
    // m (3), omega (3), theta_o, phi_o
    PositionAngle(x) {
        let observer = observer_along_z(x);
        [result(position_angle(&vector(x), &observer)), vec![position_angle_rate(&vector(x), &vector(&x[3..]), &observer)]].concat()
    }
    // distance of Theta from theta_o, theta_o, phi
    RotatingVector(x) {
        let (theta, phi) = (x[0], x[2]);
        let point = rotating_vector_point(theta, phi, x[1], S::zero());
        let gradient = rotating_vector_gradient(theta, phi, x[1], S::zero());
        let angle = rotating_vector_position_angle(theta, phi, x[1], S::zero());
        [vec![point.0, point.1], result(angle), vec![gradient.0, gradient.1]].concat()
    }
    // n (3), L (3), body, theta_o, phi_o
    Harmonics(x) {
        let state = AxisState { axis: vector(x), momentum: vector(&x[3..]) };
        WaveHarmonics::of(&body(&x[6..]), &state, &Observer::at(x[9], x[10])).map_or(none(6), |h| {
            vec![h.once, h.twice, h.phase, h.inclination, h.orientation, h.wobble]
        })
    }
    HarmonicsAdded(x) {
        let wave = WaveHarmonics { once: x[1], twice: x[2], phase: x[3], inclination: x[0], orientation: x[4], wobble: x[5] };
        let h = wave.polarizations();
        vec![h.plus, h.cross]
    }
    // beta, r, alpha
    Speeds(x) { vec![squared_speed(x[1], x[2], x[0]), mean_squared_speed(x[1], x[0])] }
    RmsEta(x) { result(root_mean_square_eta(x[1], x[0])) }
    AlongMotion(x) { vec![squared_speed_along_motion(x[1], x[2], x[0])] }
    ExactAlongMotion(x) { vec![speed_along_motion(x[1], x[2], x[0])] }
    /// `r`, then `beta` and `alpha`.
    AlongMotionByRatio(x) { vec![squared_speed_along_motion(x[0], x[2], x[1])] }
    ExactAlongMotionByRatio(x) { vec![speed_along_motion(x[0], x[2], x[1])] }
    Start(x) { let (alpha, beta) = single_precession_start(x[1], x[2], x[0]); vec![alpha, beta] }
    SecularRate(x) { joined(&[secular_axis_rate(x[6], x[7], &symmetric(x), &vector(&x[8..]))]) }
    StrainUnit(x) { vec![strain_unit(x[0], x[1], x[2])] }
    ExactStrainUnit(x) {
        vec![x[0] * S::from_f64(KILOGRAM) * S::from_f64(METRE) / (x[1] * x[1] * x[2])]
    }
    Units(x) {
        result(time_unit(x[0]))
    }
    ExactUnits(x) {
        vec![x[0].sqrt()]
    }
    // value of f, its rate
    EventTime(x) {
        let rate = x[1].re();
        result(event_time(0.0, x[0] * 1.0, rate))
    }
    ExactEventTime(x) { vec![-(x[0] / S::from_f64(x[1].re()))] }
}

/// The observer of a case of the position angle: its basis is that of the frame.
fn observer_along_z<S: Real>(_: &[S]) -> Observer<S> {
    let (o, l) = (S::zero(), S::one());
    Observer { direction: Vector3::new(o, o, l), theta_hat: Vector3::new(l, o, o), phi_hat: Vector3::new(o, l, o) }
}

/// Times of an edge and of the closest approach by the derivatives of the margin, in double-double as well.
fn times<S: Real>(x: &[S]) -> Vec<S> {
    let beam = Beam::new(x[1], x[2], x[0]);
    let (spheroid, s, state, sight) = (body(&x[21..]), symmetric(&x[3..]), state(&x[9..]), vector(&x[18..]));
    let [margin, rate, second, _] = beam.margin_rates(&spheroid, &s, &state, &sight);
    [result(event_time(0.0, margin, rate.re())), result(event_time(0.0, rate, second.re()))].concat()
}

functions! {
    EventTimes(x) { times(x) }
}

const TURN: Input = In(-3.1, 3.1);
const COMPONENT: Input = In(-1.0, 1.0);
const INERTIA: Input = In(0.5, 2.0);
const POLAR: Input = In(0.3, 2.8);
const TINY: Input = Signed(-15.0, -0.5);
const SMALL: Input = Signed(-6.0, -1.0);
const WIDTH: &[&str] = &["observables::pulsar::width::pulse_width"];
const LAMBDA: &[&str] = &["observables::spin_axis::cos_lambda_in_angles"];
const CHANGE: &[&str] = &["observables::spin_axis::cos_lambda_change"];
const ROTATING: &[&str] = &[
    "observables::pulsar::position_angle::rotating_vector_point",
    "observables::pulsar::position_angle::rotating_vector_position_angle",
    "observables::pulsar::position_angle::rotating_vector_gradient",
];
const DIRECTION: &[&str] =
    &["observables::pulsar::direction::cosine_of_colatitude", "observables::pulsar::direction::azimuth_offset_point"];
const ANGLES: &[&str] = &["observables::pulsar::direction::magnetic_axis_direction"];
const OFFSET: &[&str] = &["observables::pulsar::period::azimuth_offset_rate"];
const ALONG: &[&str] = &["observables::eta::squared_speed_along_motion"];
const MARGIN: &[&str] = &[
    "observables::pulsar::Beam::new",
    "observables::pulsar::Beam::opposite",
    "observables::pulsar::Beam::direction",
    "observables::pulsar::Beam::margin",
];

pub(super) fn cases() -> Vec<Case> {
    let (c, i, t) = (COMPONENT, INERTIA, TURN);
    let moving = [SMALL, SMALL, SMALL, SMALL, SMALL, SMALL, c, c, c, c, c, c, c, c, c, c, c, c, i, i, i];
    let mut cases = Vec::new();
    for (limit, theta) in [("theta_o -> 0", Log(-300.0, 0.4)), ("theta_o -> pi", Near(PI, -15.0, -0.3))] {
        cases.extend([
            Case::new::<Lambda>(LAMBDA, limit, &[theta, t, t, POLAR]),
            Case::new::<LambdaChange>(CHANGE, limit, &[theta, t, t, POLAR, Signed(-12.0, -1.0), Signed(-12.0, -1.0)]),
            Case::new::<InAzimuth>(
                &["observables::pulsar::direction::axis_along_line_of_sight_in_azimuth"],
                limit,
                &[theta, POLAR, t, t],
            ),
        ]);
    }
    for (limit, chi) in [("chi -> 0", Log(-300.0, 0.0)), ("chi -> pi", Near(PI, -15.0, -0.3))] {
        cases.extend([
            Case::new::<Margin>(MARGIN, limit, &[chi, t, In(0.1, 1.0), c, c, c, c, c, c, c, c, c, c, c, c]),
            Case::new::<Direction>(DIRECTION, limit, &[chi, POLAR, t, t]),
            Case::new::<DirectionAngles>(ANGLES, limit, &[chi, POLAR, t, t, t])
                .beside::<NaiveDirectionAngles>("arc cosine, cot chi")
                .composite(),
            Case::new::<OffsetRate>(OFFSET, limit, &[chi, POLAR, t, t, t, Signed(-3.0, 1.0)]).composite(),
            Case::new::<Opening>(&["observables::bound::cos_opening_angle"], limit, &[chi, POLAR, In(0.01, 6.0)]),
            Case::new::<ZetaChange>(
                &["observables::bound::zeta_change_terms"],
                limit,
                &[chi, POLAR, In(0.01, 6.0), Signed(-9.0, -2.0)],
            ),
            Case::new::<LambdaFromWidth>(
                &["observables::bound::lambda_change", "observables::bound::lambda_change_terms"],
                limit,
                &[chi, POLAR, In(0.01, 6.0), Signed(-9.0, -2.0)],
            )
            .beside::<PrintedLambdaFromWidth>("Eq. (42) as printed"),
        ]);
    }
    cases.extend([
        Case::new::<LambdaRate>(
            &["observables::spin_axis::cos_lambda_rate"],
            "a component -> 0",
            &[Signed(-300.0, 0.0), c, c, c, c, c, c, c, c, i, i, i],
        ),
        Case::new::<Drift>(
            &["observables::bound::SpinAxisDrift::combination_bound"],
            "change -> 0",
            &[Signed(-60.0, 0.0), Log(-10.0, 10.0), Log(-5.0, 5.0), Log(-5.0, 15.0), In(1.0, 10.0), In(0.0, 1.5)],
        ),
        Case::new::<EtaFromInclination>(&["observables::bound::eta_from_inclination"], "cos b -> 0", &[Near(FRAC_PI_2, -15.0, -0.1)]),
        Case::new::<FluidAndPreferred>(
            &["observables::bound::fluid_inertia_over_c", "observables::bound::preferred_frame_bound"],
            "1e-100 to 1e100",
            &[Log(-100.0, 100.0), Signed(-5.0, 0.0), Signed(-5.0, 0.0), Signed(-5.0, 0.0)],
        ),
        Case::new::<MarginRates>(
            &["observables::pulsar::Beam::margin_rates"],
            "rho -> 0",
            &[&[Log(-12.0, 0.0), t, t], &moving[..]].concat(),
        )
        .composite(),
        Case::new::<Along>(
            &["observables::pulsar::beam::axis_along_line_of_sight"],
            "sin b -> 0",
            &[Log(-300.0, 0.4), t, t, In(0.1, 3.0), t, In(0.1, 3.0), t],
        ),
        Case::new::<AzimuthRate>(
            &["observables::pulsar::period::azimuth_rate"],
            "magnetic axis to Z",
            &[TINY, TINY, Signed(-0.3, 0.0), c, c, c],
        )
        .natural_derivatives(),
        Case::new::<AzimuthRateOnSphere>(
            &["observables::pulsar::period::azimuth_rate"],
            "unit vector to Z",
            &[Log(-12.0, 0.0), t, c, c, c],
        )
        .beside::<NaiveAzimuthRate>("over 1 - m_z^2")
        .composite(),
        Case::new::<Periods>(
            &["observables::pulsar::period::instantaneous_period", "observables::pulsar::period::approximate_period"],
            "rates from 1e-100 to 1e100",
            &[Signed(-100.0, 100.0), Signed(-50.0, 50.0)],
        )
        .against::<ExactPeriods>(),
        Case::new::<Width>(WIDTH, "grazing: rho -> Theta - theta_o = 1/2", &[Above(0.5, -15.0, -1.0), Fixed(1.5), Fixed(1.0)])
            .beside::<PrintedWidth>("arc cosine of Eq. (56)")
            .composite(),
        Case::new::<NearPole>(WIDTH, "magnetic axis nearly the cone's edge from Z", &[Near(0.75, -15.0, -1.5), In(0.3, 0.5), Fixed(0.75)])
            .beside::<PrintedNearPole>("arc cosine of Eq. (56)")
            .composite(),
        Case::new::<CosineOfHalfWidth>(
            &["observables::pulsar::width::cosine_of_half_width"],
            "sin Theta -> 0",
            &[Log(-15.0, 0.0), In(0.1, 1.5), In(0.3, 2.8)],
        )
        .except(
            100.0,
            "Printed, and kept for comparison: a cosine of a small rho has the rounding of one, condition number 1 / rho^2. `pulse_width` is regular.",
        )
        .derivatives_except(100.0, "As for the value."),
        Case::new::<Edges>(&["observables::pulsar::width::edge_azimuths"], "width -> 0", &[t, Log(-300.0, 0.7)]),
        Case::new::<PositionAngle>(
            &[
                "observables::pulsar::position_angle::position_angle",
                "observables::pulsar::position_angle::position_angle_rate",
            ],
            "magnetic axis to the line of sight",
            &[TINY, TINY, Signed(-0.3, 0.0), c, c, c],
        )
        .natural_derivatives(),
        Case::new::<RotatingVector>(ROTATING, "Theta -> 0", &[Log(-300.0, 0.4), POLAR, t]).composite().natural_derivatives(),
        Case::new::<RotatingVector>(
            ROTATING,
            "magnetic axis to the line of sight",
            &[Near(1.1, -13.0, -0.5), Fixed(1.1), Signed(-13.0, -0.5)],
        )
        .composite(),
        Case::new::<Harmonics>(
            &["observables::wave_harmonics::WaveHarmonics::of"],
            "wobble -> 0",
            &[TINY, TINY, Fixed(1.0), Fixed(0.0), Fixed(0.0), In(0.5, 2.0), i, i, i, POLAR, t],
        )
        .composite()
        .natural_derivatives(),
        Case::new::<HarmonicsAdded>(
            &["observables::wave_harmonics::WaveHarmonics::polarizations"],
            "inclination -> 0",
            &[Log(-300.0, 0.4), c, c, t, t, t],
        ),
        Case::new::<Speeds>(
            &["observables::eta::squared_speed", "observables::eta::mean_squared_speed"],
            "sin b -> 0",
            &[Log(-150.0, 0.0), In(-1.0, 1.0), t],
        ),
        Case::new::<Speeds>(
            &["observables::eta::squared_speed", "observables::eta::mean_squared_speed"],
            "cos b -> 0",
            &[Near(FRAC_PI_2, -15.0, -0.3), Signed(-15.0, 0.0), t],
        ),
        Case::new::<RmsEta>(&["observables::eta::root_mean_square_eta"], "sin b -> 0", &[Log(-15.0, 0.0), In(-1.0, 1.0)]),
        Case::new::<AlongMotion>(ALONG, "sin b -> 0", &[Log(-7.0, 0.0), In(-0.9, 0.9), t]).against::<ExactAlongMotion>().composite(),
        Case::new::<AlongMotion>(ALONG, "cos b -> 0", &[Near(FRAC_PI_2, -12.0, -0.3), In(-0.9, 0.9), t])
            .against::<ExactAlongMotion>()
            .composite(),
        Case::new::<AlongMotionByRatio>(ALONG, "r -> 0", &[Signed(-12.0, -0.1), In(0.3, 1.2), t])
            .against::<ExactAlongMotionByRatio>()
            .composite(),
        Case::new::<Start>(
            &["observables::eta::single_precession_start"],
            "cos b -> 0",
            &[Near(FRAC_PI_2, -12.0, -0.3), Signed(-12.0, 0.0), t],
        ),
        Case::new::<SecularRate>(
            &["observables::eta::secular_axis_rate"],
            "s from 1e-200 to 1",
            &[Signed(-200.0, 0.0), SMALL, SMALL, SMALL, SMALL, SMALL, Log(-10.0, 10.0), Signed(-10.0, 10.0), c, c, c],
        ),
        Case::new::<StrainUnit>(
            &["observables::gravitational_wave::strain_unit"],
            "SI units of stars",
            &[Log(30.0, 45.0), Log(-6.0, 3.0), Log(10.0, 26.0)],
        )
        .against::<ExactStrainUnit>(),
        Case::new::<Units>(
            &["units::time_unit"],
            "unit from 1e-100 to 1e100",
            &[Log(-100.0, 100.0)],
        )
        .against::<ExactUnits>(),
        Case::new::<EventTime>(
            &["observables::pulsar::event_time::event_time"],
            "f -> 0 at the root",
            &[Signed(-200.0, -1.0), Signed(-50.0, 50.0)],
        )
        .against::<ExactEventTime>(),
        Case::new::<EventTimes>(
            &["observables::pulsar::event_time::event_time"],
            "rho from 0.03 to 1, any state",
            &[&[Log(-1.5, 0.0), t, t], &moving[..]].concat(),
        )
        .except(
            1e4,
            "Of a cone of rho = 0.03 and less `m.n - cos rho` is rounded as one is: condition number 1 / rho^2 of the cosine, which the scale does not \
             hold against the input.",
        )
        .values_only(),
    ]);
    cases
}
