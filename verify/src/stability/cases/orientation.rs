//! Euler angles: rotation matrix, rates and their inverses.

use twofold::dynamics::equations_of_motion::euler_rates_of_axis;
use twofold::euler_angles::{angles_from_rotation, euler_rates};
use twofold::observables::pulsar::position_angle::sky_from_inertial;

use super::parts::*;

functions! {
    Rotation: "body_from_inertial", (x) { entries(&body_from_inertial(&angles(&[x[1], x[0], x[2]]))) }
    Axis: "symmetry_axis", (x) { joined(&[symmetry_axis(x[1], x[0])]) }
    BodyRates: "body_rates", (x) { joined(&[body_rates(&angles(&[x[1], x[0], x[2]]), &rates(&x[3..]))]) }
    EulerRates: "euler_rates", (x) {
        euler_rates(&angles(&[x[1], x[0], x[2]]), &vector(&x[3..])).map_or(none(3), |rates| of_rates(&rates))
    }
    /// The third row and column of a rotation, as far as the angles need them.
    Angles: "angles_from_rotation", (x) {
        let o = S::zero();
        let rotation = Matrix3::new(o, o, x[3], o, o, x[4], x[0], x[1], x[2]);
        angles_from_rotation(&rotation).map_or(none(3), |angles| of_angles(&angles))
    }
    /// With sqrt(1 - z^2), as in an arc cosine.
    NaiveAngles(x) {
        let z = x[2];
        vec![x[0].atan2(-x[1]), ((S::one() - z * z).sqrt()).atan2(z), x[3].atan2(x[4])]
    }
    AnglesOnSphere: "angles_from_rotation".composite().beside::<NaiveAnglesOnSphere>("arc cosine of n_z"), (x) {
        let (sin, cos) = x[0].sin_cos();
        let (sa, ca) = x[1].sin_cos();
        vec![Angles::of(&[sa * sin, -(ca * sin), cos, sin, sin])[1]]
    }
    NaiveAnglesOnSphere(x) {
        let (sin, cos) = x[0].sin_cos();
        let (sa, ca) = x[1].sin_cos();
        vec![NaiveAngles::of(&[sa * sin, -(ca * sin), cos, sin, sin])[1]]
    }
    TensorInBody: "tensor_in_body_frame", (x) { entries(&tensor_in_body_frame(&matrix(&x[6..]), &symmetric(x))) }
    TensorInInertial: "tensor_in_inertial_frame", (x) {
        entries(&tensor_in_inertial_frame(&matrix(&x[6..]), &symmetric(x)))
    }
    RotationRate: "rotation_rate", (x) { entries(&rotation_rate(&matrix(&x[3..]), &vector(x))) }
    AngularVelocity: "angular_velocity", (x) {
        joined(&[angular_velocity(&body(&x[0..]), &vector(&x[3..]), &vector(&x[6..]))])
    }
    /// `I^xx` and `I^zz / I^xx` in units of any size.
    AngularVelocityInUnits: "angular_velocity", (x) {
        let spheroid = body(&[x[0], x[0] * x[1], S::one()]);
        joined(&[angular_velocity(&spheroid, &vector(&x[2..]), &vector(&x[5..]))])
    }
    RatesOfAxis: "euler_rates_of_axis".natural_derivatives(), (x) {
        euler_rates_of_axis(&body(&x[6..]), &vector(x), &vector(&x[3..])).map_or(none(3), |rates| of_rates(&rates))
    }
    StateFromAngles: "BodyState::from_angles".composite(), (x) {
        let state = BodyState::from_angles(&body(&x[6..]), &angles(&[x[1], x[0], x[2]]), &rates(&x[3..]));
        of_state(&state)
    }
    RotationOfState: "BodyState::body_from_inertial", (x) {
        let state = BodyState { axis: vector(x), momentum: vector(x), equatorial_axis: vector(&x[3..]) };
        entries(&state.body_from_inertial())
    }
    StateRotated: "BodyState::rotated", (x) {
        let state = state(x);
        let state = state.rotated(&matrix(&x[9..]));
        of_state(&state)
    }
    /// Angles and rates of a state.
    OfState: "BodyState: angles, rates".composite().natural_derivatives(), (x) {
        let state = BodyState { axis: vector(x), equatorial_axis: vector(&x[3..]), momentum: vector(&x[6..]) };
        match (state.angles(), state.rates(&body(&x[9..]))) {
            (Ok(angles), Ok(rates)) => [of_angles(&angles), of_rates(&rates)].concat(),
            _ => none(6),
        }
    }
    ObserverBasis: "Observer::at", (x) {
        let observer = Observer::at(x[0], x[1]);
        joined(&[observer.direction, observer.theta_hat, observer.phi_hat])
    }
    ObserverRotated: "Observer::rotated, sky_from_inertial", (x) {
        let observer = Observer { direction: vector(x), theta_hat: vector(&x[3..]), phi_hat: vector(&x[6..]) };
        let observer = observer.rotated(&matrix(&x[9..]));
        [joined(&[observer.direction, observer.theta_hat, observer.phi_hat]), entries(&sky_from_inertial(&observer))].concat()
    }
}

pub(super) fn cases() -> Vec<Case> {
    let (north, south) = (Log(-300.0, 0.0), Near(PI, -15.0, -0.5));
    let mut cases = Vec::new();
    for (limit, beta) in [
        ("sin b -> 0 at beta = 0", north),
        ("sin b -> 0 at beta = pi", south),
        ("cos b -> 0", Near(FRAC_PI_2, -15.0, -0.3)),
    ] {
        let sweep = &[beta, TURN, TURN, RATE, RATE, RATE, INERTIA, INERTIA, Fixed(1.0)];
        let off_pole = if beta == north { Log(-15.0, 0.0) } else { beta };
        let off_pole = [off_pole, TURN, TURN, RATE, RATE, RATE];
        cases.extend([
            Rotation::case(limit, &sweep[..3]),
            Axis::case(limit, &sweep[..2]),
            BodyRates::case(limit, &sweep[..6]),
            EulerRates::case(limit, &off_pole),
            StateFromAngles::case(limit, sweep),
        ]);
    }
    cases.extend([
        OfState::case("axis to either pole", &list![Signed(-15.0, -0.5); 2, Signed(-0.3, 0.0), COMPONENT; 2, Signed(-15.0, -0.5), COMPONENT; 3, INERTIA; 2, Fixed(1.0)]),
        Angles::case("axis to either pole", &[Signed(-15.0, -0.5), Signed(-15.0, -0.5), Signed(-0.3, 0.0), Signed(-15.0, -0.5), Signed(-15.0, -0.5)]),
        AnglesOnSphere::case("beta of a unit vector, sin b -> 0", &[Log(-15.0, 0.0), TURN]),
        RatesOfAxis::case("axis to either pole", &list![Signed(-15.0, -0.5); 2, Signed(-0.3, 0.0), COMPONENT; 3, INERTIA; 2, Fixed(1.0)]),
        TensorInBody::case("s -> 0 from 1e-300 to 1", &list![Signed(-300.0, 0.0); 6, COMPONENT; 9]),
        TensorInInertial::case("entries from 1e-300 to 1", &list![Signed(-300.0, 0.0); 6, COMPONENT; 9]),
        RotationRate::case("rates from 1e-300 to 1e300", &list![Signed(-300.0, 299.0), Signed(-3.0, 3.0); 2, COMPONENT; 9]),
        AngularVelocityInUnits::case("units: I^xx from 1e-100 to 1e100", &list![Log(-100.0, 100.0), In(0.2, 2.0), COMPONENT; 6]),
        AngularVelocity::case("I^zz -> I^xx", &list![Near(1.0, -15.5, -0.5), Fixed(1.0); 2, COMPONENT; 6]),
        RotationOfState::case("a component of n -> 0", &list![Signed(-300.0, 0.0), COMPONENT; 5]),
        StateRotated::case("a component of n -> 0", &list![Signed(-300.0, 0.0), COMPONENT; 17]),
        ObserverBasis::case("theta_o -> 0", &[Log(-300.0, 0.0), TURN]),
        ObserverBasis::case("theta_o -> pi", &[south, TURN]),
        ObserverRotated::case("a component -> 0", &list![Signed(-300.0, 0.0), COMPONENT; 17]),
    ]);
    cases
}
