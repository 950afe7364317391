//! Observables: spin axis, bounds, beams, pulses, position angle, wave harmonics, eta, epochs.

use twofold::epoch::{DAY, Epoch};
use twofold::observables::bound::{lambda_change, preferred_frame_bound};
use twofold::observables::eta::{
    mean_squared_speed, root_mean_square_eta, single_precession_start, squared_speed, squared_speed_along_motion,
};
use twofold::observables::gravitational_wave::strain_unit;
use twofold::observables::pulsar::event_time::event_time;
use twofold::observables::pulsar::position_angle::{
    position_angle, position_angle_rate, rotating_vector_gradient, rotating_vector_point,
    rotating_vector_position_angle,
};
use twofold::observables::pulsar::width::edge_azimuths;
use twofold::observables::wave_harmonics::WaveHarmonics;
use twofold::units::geometrised::{KILOGRAM, METRE};
use twofold::units::time_unit;

use super::parts::*;

fn width<S: Real>(width: PulseWidth<S>) -> Vec<S> {
    match width {
        PulseWidth::Pulsed(width) => vec![width],
        PulseWidth::AlwaysOn | PulseWidth::NeverOn => none(1),
    }
}

/// Unit vector from colatitude and azimuth.
fn on_sphere<S: Real>(x: &[S]) -> Vector3<S> {
    let ((st, ct), (sp, cp)) = (x[0].sin_cos(), x[1].sin_cos());
    Vector3::new(st * cp, st * sp, ct)
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
    // R_D and R_F are not differentiable at zero: the argument is far below the smallest parameter.
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
    Lambda: "cos_lambda_in_angles", (x) { vec![cos_lambda_in_angles(x[0], x[1], x[2], x[3])] }
    LambdaChange: "cos_lambda_change", (x) { vec![cos_lambda_change(x[0], x[1], (x[2], x[3]), (x[4], x[5]))] }
    LambdaRate: "cos_lambda_rate", (x) {
        vec![cos_lambda_rate(&body(&x[9..]), &vector(x), &vector(&x[3..]), &vector(&x[6..]))]
    }
    Drift: "SpinAxisDrift::combination_bound", (x) {
        let drift = SpinAxisDrift { cos_lambda_change: x[0], polar_inertia_over_c: x[1], spin: x[2], interval: x[3] };
        let by_inclination = eta_from_inclination(x[5]).and_then(|eta| drift.combination_bound(eta));
        [result(drift.combination_bound(x[4])), result(by_inclination)].concat()
    }
    EtaFromInclination: "eta_from_inclination", (x) { result(eta_from_inclination(x[0])) }
    FluidAndPreferred: "fluid_inertia_over_c, preferred_frame_bound", (x) {
        [vec![fluid_inertia_over_c(x[0])], result(preferred_frame_bound(x[0], &vector(&x[1..])))].concat()
    }
    // chi or zeta, the other, width, its change
    Opening: "cos_opening_angle", (x) { vec![cos_opening_angle(x[1], x[0], x[2])] }
    ZetaChange: "zeta_change_terms", (x) {
        let [sine, turning] = zeta_change_terms(x[1], x[0], x[2]);
        vec![sine / turning * x[3]]
    }
    LambdaFromWidth: "lambda_change".beside::<PrintedLambdaFromWidth>("Eq. (42) as printed"), (x) {
        result(lambda_change(x[1], x[0], x[2], x[3]))
    }
    /// With cotangents, Eq. (42) as printed.
    PrintedLambdaFromWidth(x) {
        let ((sl, cl), (sc, cc), (sw, cw)) = (x[1].sin_cos(), x[0].sin_cos(), (x[2] / 2.0).sin_cos());
        vec![sw / (cl / sl * cw + cc / sc) * x[3] / 2.0]
    }
    // chi, delta, rho, state (9), line of sight (3)
    Margin: "Beam: new, opposite, direction, margin", (x) {
        let beam = Beam::new(x[0], x[1], x[2]);
        let state = state(&x[3..]);
        let mut all = joined(&[beam.direction(&state), beam.opposite().axis]);
        all.push(beam.margin(&state, &vector(&x[12..])));
        all
    }
    // rho, chi, delta, s (6), state (9), line of sight (3), body (3)
    MarginRates: "Beam::margin_rates".composite(), (x) {
        let beam = Beam::new(x[1], x[2], x[0]);
        beam.margin_rates(&body(&x[21..]), &symmetric(&x[3..]), S::zero(), &state(&x[9..]), &vector(&x[18..])).to_vec()
    }
    // beta, alpha, gamma, chi, delta, theta_o, phi_o
    Along: "axis_along_line_of_sight", (x) {
        vec![axis_along_line_of_sight(&angles(&[x[1], x[0], x[2]]), x[3], x[4], x[5], x[6])]
    }
    // chi, beta, gamma, delta, alpha, rate of gamma
    Direction: "cosine_of_colatitude, azimuth_offset_point", (x) {
        let (offset_x, offset_y) = azimuth_offset_point(x[1], x[2], x[0], x[3]);
        vec![cosine_of_colatitude(x[1], x[2], x[0], x[3]), offset_x, offset_y]
    }
    DirectionAngles: "magnetic_axis_direction".composite().beside::<NaiveDirectionAngles>("arc cosine, cot chi"), (x) {
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
    OffsetRate: "azimuth_offset_rate".composite(), (x) { vec![azimuth_offset_rate(x[1], x[2], x[5], x[0], x[3])] }
    InAzimuth: "axis_along_line_of_sight_in_azimuth", (x) {
        vec![axis_along_line_of_sight_in_azimuth(x[1], x[2], x[0], x[3])]
    }
    // m_x, m_y, m_z, omega
    AzimuthRate: "azimuth_rate".natural_derivatives(), (x) { vec![azimuth_rate(&vector(x), &vector(&x[3..]))] }
    // Theta, Phi, omega
    AzimuthRateOnSphere: "azimuth_rate".composite().beside::<NaiveAzimuthRate>("over 1 - m_z^2"), (x) {
        vec![azimuth_rate(&on_sphere(x), &vector(&x[2..]))]
    }
    NaiveAzimuthRate(x) {
        let (m, omega) = (on_sphere(x), vector(&x[2..]));
        vec![(omega.z - omega.dot(&m) * m.z) / (S::one() - m.z * m.z)]
    }
    Periods: "instantaneous_period, approximate_period".against::<ExactPeriods>(), (x) {
        vec![instantaneous_period(x[1]), approximate_period(x[1], x[0])]
    }
    ExactPeriods(x) {
        let turn = pi::<S>() * 2.0;
        vec![turn / x[1], turn / x[1] * (S::one() - x[0] / x[1])]
    }
    NearPole: "pulse_width".composite().beside::<PrintedNearPole>("arc cosine of Eq. (56)"), (x) {
        width(pulse_width(x[1], x[0], x[2]))
    }
    PrintedNearPole(x) {
        let cosine = cosine_of_half_width(x[1], x[0], x[2]);
        vec![(S::one() - cosine * cosine).sqrt().atan2(cosine) * 2.0]
    }
    // half opening, colatitudes
    Width: "pulse_width".composite().beside::<PrintedWidth>("arc cosine of Eq. (56)"), (x) {
        width(pulse_width(x[0], x[1], x[2]))
    }
    PrintedWidth(x) {
        let cosine = cosine_of_half_width(x[0], x[1], x[2]);
        vec![(S::one() - cosine * cosine).sqrt().atan2(cosine) * 2.0]
    }
    CosineOfHalfWidth: "cosine_of_half_width", (x) { vec![cosine_of_half_width(x[1], x[0], x[2])] }
    Edges: "edge_azimuths", (x) { let (first, last) = edge_azimuths(x[0], x[1]); vec![first, last] }
    // m (3), omega (3), theta_o, phi_o
    PositionAngle: "position_angle, position_angle_rate".natural_derivatives(), (x) {
        let observer = observer_along_z(x);
        [result(position_angle(&vector(x), &observer)), vec![position_angle_rate(&vector(x), &vector(&x[3..]), &observer)]].concat()
    }
    // distance of Theta from theta_o, theta_o, phi
    RotatingVector: "rotating_vector_point, _position_angle, _gradient".composite(), (x) {
        let (theta, phi) = (x[0], x[2]);
        let point = rotating_vector_point(theta, phi, x[1], S::zero());
        let gradient = rotating_vector_gradient(theta, phi, x[1], S::zero());
        let angle = rotating_vector_position_angle(theta, phi, x[1], S::zero());
        [vec![point.0, point.1], result(angle), vec![gradient.0, gradient.1]].concat()
    }
    // n (3), L (3), body, theta_o, phi_o
    Harmonics: "WaveHarmonics::of".composite().natural_derivatives(), (x) {
        let state = AxisState { axis: vector(x), momentum: vector(&x[3..]) };
        WaveHarmonics::of(&body(&x[6..]), &state, &Observer::at(x[9], x[10])).map_or(none(6), |h| {
            vec![h.once, h.twice, h.phase, h.inclination, h.orientation, h.wobble]
        })
    }
    HarmonicsAdded: "WaveHarmonics::polarizations", (x) {
        let wave = WaveHarmonics { once: x[1], twice: x[2], phase: x[3], inclination: x[0], orientation: x[4], wobble: x[5] };
        let h = wave.polarizations();
        vec![h.plus, h.cross]
    }
    // beta, r, alpha
    Speeds: "squared_speed, mean_squared_speed", (x) {
        vec![squared_speed(x[1], x[2], x[0]), mean_squared_speed(x[1], x[0])]
    }
    RmsEta: "root_mean_square_eta", (x) { result(root_mean_square_eta(x[1], x[0])) }
    AlongMotion: "squared_speed_along_motion".against::<ExactAlongMotion>().composite(), (x) {
        vec![squared_speed_along_motion(x[1], x[2], x[0])]
    }
    ExactAlongMotion(x) { vec![speed_along_motion(x[1], x[2], x[0])] }
    /// `r`, then `beta` and `alpha`.
    AlongMotionByRatio: "squared_speed_along_motion".against::<ExactAlongMotionByRatio>().composite(), (x) {
        vec![squared_speed_along_motion(x[0], x[2], x[1])]
    }
    ExactAlongMotionByRatio(x) { vec![speed_along_motion(x[0], x[2], x[1])] }
    Start: "single_precession_start", (x) {
        let (alpha, beta) = single_precession_start(x[1], x[2], x[0]); vec![alpha, beta]
    }
    SecularRate: "secular_axis_rate", (x) { joined(&[secular_axis_rate(x[6], x[7], &symmetric(x), &vector(&x[8..]))]) }
    StrainUnit: "strain_unit".against::<ExactStrainUnit>(), (x) { vec![strain_unit(x[0], x[1], x[2])] }
    ExactStrainUnit(x) {
        vec![x[0] * S::from_f64(KILOGRAM) * S::from_f64(METRE) / (x[1] * x[1] * x[2])]
    }
    Units: "time_unit".against::<ExactUnits>(), (x) {
        result(time_unit(x[0]))
    }
    ExactUnits(x) {
        vec![x[0].sqrt()]
    }
    // value of f, its rate
    EventTime: "event_time".against::<ExactEventTime>(), (x) {
        let rate = x[1].re();
        result(event_time(0.0, x[0] * 1.0, rate))
    }
    ExactEventTime(x) { vec![-(x[0] / S::from_f64(x[1].re()))] }
    EventTimes: "event_time".values_only(), (x) { times(x) }
    // probability, speeds (2), weights (2)
    Probability(x) { vec![S::one() - x[0]] }
    RootMeanSquare(x) {
        let (v, w) = ([x[1], x[2]], [x[3], x[4]]);
        vec![(S::from_f64(3.0) * (w[0] + w[1]) / (w[0] * v[0] * v[0] + w[1] * v[1] * v[1])).sqrt()]
    }
    // seconds, fraction
    Seconds(x) { vec![x[0]] }
    Fraction(x) {
        let days = x[1] + x[0] / DAY;
        vec![days - S::from_f64(days.re().floor())]
    }
}

/// The observer in the position-angle cases: its basis is that of the frame.
fn observer_along_z<S: Real>(_: &[S]) -> Observer<S> {
    let (o, l) = (S::zero(), S::one());
    Observer { direction: Vector3::new(o, o, l), theta_hat: Vector3::new(l, o, o), phi_hat: Vector3::new(o, l, o) }
}

/// Times of an edge and of the closest approach from the derivatives of the margin, also in double-double numbers.
fn times<S: Real>(x: &[S]) -> Vec<S> {
    let beam = Beam::new(x[1], x[2], x[0]);
    let (spheroid, s, state, sight) = (body(&x[21..]), symmetric(&x[3..]), state(&x[9..]), vector(&x[18..]));
    let [margin, rate, second, _] = beam.margin_rates(&spheroid, &s, S::zero(), &state, &sight);
    [result(event_time(0.0, margin, rate.re())), result(event_time(0.0, rate, second.re()))].concat()
}

fn two_speeds(x: &[f64]) -> Option<EtaDistribution> {
    EtaDistribution::from_speeds([(x[1], x[3]), (x[2], x[4])]).ok()
}

fn probability(x: &[f64]) -> Vec<f64> {
    two_speeds(x).map_or(none(1), |of| of.quantile(x[0]).map_or(none(1), |eta| vec![of.probability_above(eta)]))
}

fn root_mean_square(x: &[f64]) -> Vec<f64> {
    two_speeds(x).map_or(none(1), |of| vec![of.root_mean_square()])
}

fn epoch(x: &[f64]) -> Option<Epoch> {
    Epoch::new(50_000, x[1]).ok()
}

fn seconds(x: &[f64]) -> Vec<f64> {
    // From the start of the day, where the fraction is given by the seconds.
    let start = Epoch::new(50_000, 0.0).expect("a date");
    let end = start.after([x[0], 0.0]).expect("a date");
    let [high, low] = end.seconds_since(&start);
    vec![high + low]
}

fn fraction(x: &[f64]) -> Vec<f64> {
    epoch(x).map_or(none(1), |start| start.after([x[0], 0.0]).map_or(none(1), |end| vec![end.fraction()]))
}

const POLAR: Input = In(0.3, 2.8);
const TINY: Input = Signed(-15.0, -0.5);
const SMALL: Input = Signed(-6.0, -1.0);

pub(super) fn cases() -> Vec<Case> {
    let (c, i, t) = (COMPONENT, INERTIA, TURN);
    let moving = [SMALL, SMALL, SMALL, SMALL, SMALL, SMALL, c, c, c, c, c, c, c, c, c, c, c, c, i, i, i];
    let two = [Log(-5.0, 0.0), Log(-5.0, 0.0), In(0.1, 1.0), In(0.1, 1.0)];
    let mut cases = Vec::new();
    for (limit, theta) in [("theta_o -> 0", Log(-300.0, 0.4)), ("theta_o -> pi", Near(PI, -15.0, -0.3))] {
        cases.extend([
            Lambda::case(limit, &[theta, t, t, POLAR]),
            LambdaChange::case(limit, &[theta, t, t, POLAR, Signed(-12.0, -1.0), Signed(-12.0, -1.0)]),
            InAzimuth::case(limit, &[theta, POLAR, t, t]),
        ]);
    }
    for (limit, chi) in [("chi -> 0", Log(-300.0, 0.0)), ("chi -> pi", Near(PI, -15.0, -0.3))] {
        cases.extend([
            Margin::case(limit, &list![chi, t, In(0.1, 1.0), c; 12]),
            Direction::case(limit, &[chi, POLAR, t, t]),
            DirectionAngles::case(limit, &[chi, POLAR, t, t, t]),
            OffsetRate::case(limit, &list![chi, POLAR, t; 3, Signed(-3.0, 1.0)]),
            Opening::case(limit, &[chi, POLAR, In(0.01, 6.0)]),
            ZetaChange::case(limit, &[chi, POLAR, In(0.01, 6.0), Signed(-9.0, -2.0)]),
            LambdaFromWidth::case(limit, &[chi, POLAR, In(0.01, 6.0), Signed(-9.0, -2.0)]),
        ]);
    }
    cases.extend([
        LambdaRate::case("a component -> 0", &list![Signed(-300.0, 0.0), c; 8, i; 3]),
        Drift::case(
            "change -> 0",
            &[Signed(-60.0, 0.0), Log(-10.0, 10.0), Log(-5.0, 5.0), Log(-5.0, 15.0), In(1.0, 10.0), In(0.0, 1.5)],
        ),
        EtaFromInclination::case("cos b -> 0", &[Near(FRAC_PI_2, -15.0, -0.1)]),
        FluidAndPreferred::case("1e-100 to 1e100", &list![Log(-100.0, 100.0), Signed(-5.0, 0.0); 3]),
        MarginRates::case("rho -> 0", &[&[Log(-12.0, 0.0), t, t], &moving[..]].concat()),
        Along::case("sin b -> 0", &[Log(-300.0, 0.4), t, t, In(0.1, 3.0), t, In(0.1, 3.0), t]),
        AzimuthRate::case("magnetic axis to Z", &list![TINY; 2, Signed(-0.3, 0.0), c; 3]),
        AzimuthRateOnSphere::case("unit vector to Z", &[Log(-12.0, 0.0), t, c, c, c]),
        Periods::case("rates from 1e-100 to 1e100", &[Signed(-100.0, 100.0), Signed(-50.0, 50.0)]),
        Width::case("grazing: rho -> Theta - theta_o = 1/2", &[Above(0.5, -15.0, -1.0), Fixed(1.5), Fixed(1.0)]),
        NearPole::case(
            "magnetic axis nearly the cone's edge from Z",
            &[Near(0.75, -15.0, -1.5), In(0.3, 0.5), Fixed(0.75)],
        ),
        CosineOfHalfWidth::case("sin Theta -> 0", &[Log(-15.0, 0.0), In(0.1, 1.5), In(0.3, 2.8)])
            .except(
                100.0,
                "Printed, and kept for comparison: a cosine of a small rho has the rounding of one, \
condition number 1 / rho^2. `pulse_width` is regular.",
            )
            .derivatives_except(100.0, "As for the value."),
        Edges::case("width -> 0", &[t, Log(-300.0, 0.7)]),
        PositionAngle::case("magnetic axis to the line of sight", &list![TINY; 2, Signed(-0.3, 0.0), c; 3]),
        RotatingVector::case("Theta -> 0", &[Log(-300.0, 0.4), POLAR, t]).natural_derivatives(),
        RotatingVector::case(
            "magnetic axis to the line of sight",
            &[Near(1.1, -13.0, -0.5), Fixed(1.1), Signed(-13.0, -0.5)],
        ),
        Harmonics::case("wobble -> 0", &list![TINY; 2, Fixed(1.0), Fixed(0.0); 2, In(0.5, 2.0), i; 3, POLAR, t]),
        HarmonicsAdded::case("inclination -> 0", &list![Log(-300.0, 0.4), c; 2, t; 3]),
        Speeds::case("sin b -> 0", &[Log(-150.0, 0.0), In(-1.0, 1.0), t]),
        Speeds::case("cos b -> 0", &[Near(FRAC_PI_2, -15.0, -0.3), Signed(-15.0, 0.0), t]),
        RmsEta::case("sin b -> 0", &[Log(-15.0, 0.0), In(-1.0, 1.0)]),
        AlongMotion::case("sin b -> 0", &[Log(-7.0, 0.0), In(-0.9, 0.9), t]),
        AlongMotion::case("cos b -> 0", &[Near(FRAC_PI_2, -12.0, -0.3), In(-0.9, 0.9), t]),
        AlongMotionByRatio::case("r -> 0", &[Signed(-12.0, -0.1), In(0.3, 1.2), t]),
        Start::case("cos b -> 0", &[Near(FRAC_PI_2, -12.0, -0.3), Signed(-12.0, 0.0), t]),
        SecularRate::case(
            "s from 1e-200 to 1",
            &list![Signed(-200.0, 0.0), SMALL; 5, Log(-10.0, 10.0), Signed(-10.0, 10.0), c; 3],
        ),
        StrainUnit::case("SI units of stars", &[Log(30.0, 45.0), Log(-6.0, 3.0), Log(10.0, 26.0)]),
        Units::case("unit from 1e-100 to 1e100", &[Log(-100.0, 100.0)]),
        EventTime::case("f -> 0 at the root", &[Signed(-200.0, -1.0), Signed(-50.0, 50.0)]),
        EventTimes::case("rho from 0.03 to 1, any state", &[&[Log(-1.5, 0.0), t, t], &moving[..]].concat()).except(
            1e4,
            "Of a cone of rho = 0.03 and less `m.n - cos rho` is rounded as one is: condition number \
1 / rho^2 of the cosine, which the scale does not hold against the input.",
        ),
        Case::of_doubles::<Probability>(
            "EtaDistribution: from_speeds, quantile, probability_above",
            "probability -> 0 and 1",
            &[&[In(0.001, 0.999)], &two[..]].concat(),
            probability,
        ),
        Case::of_doubles::<RootMeanSquare>(
            "EtaDistribution::root_mean_square",
            "speeds -> 0",
            &[&[Fixed(0.5)], &two[..]].concat(),
            root_mean_square,
        ),
        Case::of_doubles::<Seconds>(
            "Epoch: after, seconds_since",
            "from 1 day to 27,000 years and back",
            &[Log(4.95, 11.5), Fixed(0.0)],
            seconds,
        ),
        Case::of_doubles::<Fraction>(
            "Epoch: new, after, day, fraction",
            "a time from 1e-12 s to 1e11 s",
            &[Signed(-12.0, 9.0), In(0.0, 0.999)],
            fraction,
        )
        .unit(),
    ]);
    cases
}
