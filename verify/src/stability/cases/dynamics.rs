//! Potential, torque, energies, equations of motion, integrals, the wave source.

use twofold::dynamics::point_masses::preferred_frame_potential_of_masses;
use twofold::lorentz_violation::preferred_frame_parameter;

use super::parts::*;

fn inertia<S: Real>(x: &[S]) -> PrincipalInertia<S> {
    PrincipalInertia { xx: x[0], yy: x[1], zz: x[2] }
}

fn axis_angles<S: Real>(x: &[S]) -> AxisAngles<S> {
    AxisAngles { beta: x[0], alpha: x[1], alpha_rate: x[2], beta_rate: x[3] }
}

functions! {
    // beta, alpha, C, s (3)
    PotentialInAngles: "anisotropic_potential_in_angles", (x) {
        vec![anisotropic_potential_in_angles(x[2], &principal(&x[3..]), x[1], x[0])]
    }
    Gradient: "potential_gradient_in_angles", (x) {
        let (by_alpha, by_beta) = potential_gradient_in_angles(x[2], &principal(&x[3..]), x[1], x[0]);
        vec![by_alpha, by_beta]
    }
    // s (6), n (3), C
    PotentialOfAxis: "anisotropic_potential_of_axis", (x) {
        vec![anisotropic_potential_of_axis(x[9], &symmetric(x), &vector(&x[6..]))]
    }
    TorqueOnAxis: "torque_on_axis", (x) { joined(&[torque_on_axis(x[9], &symmetric(x), &vector(&x[6..]))]) }
    // As a product of the matrix with its normal axis.
    PotentialOfBody: "anisotropic_potential_of_body", (x) {
        vec![anisotropic_potential_of_body(&symmetric(x), &symmetric(&x[6..]))]
    }
    TorqueOnBody: "torque_on_body", (x) { joined(&[torque_on_body(&symmetric(x), &symmetric(&x[6..]))]) }
    Nordtvedt: "nordtvedt_potential", (x) { vec![nordtvedt_potential(x[0], x[1], &vector(&x[2..]), &vector(&x[5..]))] }
    // s (6), masses (2), r, n (3)
    PotentialOfMasses: "anisotropic_potential_of_masses", (x) {
        vec![anisotropic_potential_of_masses(&symmetric(x), [x[6], x[7]], x[8], &vector(&x[9..]))]
    }
    // alpha_2, w (3), masses (2), r, n (3)
    PreferredFrameOfMasses: "preferred_frame_potential_of_masses", (x) {
        vec![preferred_frame_potential_of_masses(x[0], &vector(&x[1..]), [x[4], x[5]], x[6], &vector(&x[7..]))]
    }
    FromPreferredFrame: "coefficients_from_preferred_frame", (x) {
        entries(&coefficients_from_preferred_frame(x[0], &vector(&x[1..])))
    }
    PreferredFrameParameter: "preferred_frame_parameter".against::<ThePreferredFrameParameter>().composite(), (x) {
        let w = vector(&x[1..]);
        preferred_frame_parameter(&coefficients_from_preferred_frame(x[0], &w), &w).map_or(none(1), |alpha| vec![alpha])
    }
    ThePreferredFrameParameter(x) { vec![x[0]] }
    // beta, gamma, gradient (3)
    TorqueFromGradient: "torque_from_gradient", (x) {
        joined(&[torque_from_gradient(&angles(&[S::zero(), x[0], x[1]]), &vector(&x[2..]))])
    }
    // omega (3), torque (3), inertia (3)
    Acceleration: "angular_acceleration", (x) {
        joined(&[angular_acceleration(&inertia(&x[6..]), &vector(x), &vector(&x[3..]))])
    }
    Differences: "PrincipalInertia::differences", (x) { inertia(x).differences().to_vec() }
    EnergyOfBody: "kinetic_energy_of_body", (x) { vec![kinetic_energy_of_body(&inertia(&x[3..]), &vector(x))] }
    WaveTensor: "wave_tensor", (x) { entries(&wave_tensor(&inertia(&x[6..]), &vector(x), &vector(&x[3..]))) }
    // beta, alpha, gamma, rates (3), body (3), s (3)
    KineticEnergy: "kinetic_energy", (x) { vec![kinetic_energy(&body(&x[6..]), x[0], &rates(&x[3..]))] }
    EnergyInAngles: "energy_in_angles, lagrangian, spin_in_angles".composite(), (x) {
        let angles = angles(&[x[1], x[0], x[2]]);
        vec![
            energy_in_angles(&body(&x[6..]), &principal(&x[9..]), &angles, &rates(&x[3..])),
            lagrangian(&body(&x[6..]), &principal(&x[9..]), &angles, &rates(&x[3..])),
            spin_in_angles(&angles, &rates(&x[3..])),
        ]
    }
    // beta, alpha, rates (2), spin, body (3), s (3)
    Accelerations: "euler_angle_accelerations".beside::<NaiveAccelerations>("Eq. (25) over sin^2 b"), (x) {
        let (alpha, beta) = euler_angle_accelerations(&body(&x[5..]), &principal(&x[8..]), x[4], &axis_angles(x));
        vec![alpha, beta]
    }
    /// The force along alpha is divided by the square of the sine, as in Eq. (25).
    NaiveAccelerations(x) {
        let (spheroid, q) = (body(&x[5..]), axis_angles(x));
        let (sb, cb) = q.beta.sin_cos();
        let omega = spheroid.free_precession_constant(x[4]);
        let (by_alpha, by_beta) = potential_gradient_in_angles(spheroid.constant_c, &principal(&x[8..]), q.alpha, q.beta);
        let sine2 = sb * sb;
        vec![
            (omega * sb * q.beta_rate - sb * cb * q.alpha_rate * q.beta_rate * 2.0 - by_alpha / spheroid.inertia_xx) / sine2,
            sb * cb * q.alpha_rate * q.alpha_rate - omega * sb * q.alpha_rate - by_beta / spheroid.inertia_xx,
        ]
    }
    Residuals: "euler_angle_residuals".composite(), (x) {
        let (alpha, beta) =
            euler_angle_residuals(&body(&x[5..]), &principal(&x[8..]), x[4], &axis_angles(x), (x[11], x[12]));
        vec![alpha, beta]
    }
    // s (6), n, L, e_x (9), body (3)
    ReducedRates: "reduced_rates".composite(), (x) {
        let (axis, momentum) = reduced_rates(&body(&x[15..]), &symmetric(x), &vector(&x[6..]), &vector(&x[9..]));
        joined(&[axis, momentum])
    }
    StateRates: "body_state_rates".composite(), (x) {
        let rates = body_state_rates(&body(&x[15..]), &symmetric(x), &state(&x[6..]));
        of_state(&rates)
    }
    Integrals: "first_integrals".composite(), (x) {
        let all = first_integrals(&body(&x[15..]), &symmetric(x), &state(&x[6..]));
        vec![all.energy, all.spin, all.clebsch]
    }
    Energy: "first_integrals".beside::<NaiveEnergy>("L.L / (2 I^xx) and the rest"), (x) {
        let spheroid = body(&x[3..]);
        vec![first_integrals(&spheroid, &symmetric(&x[6..]), &AxisState { axis: Vector3::z(), momentum: vector(x) }).energy]
    }
    /// `L.L / (2 I^xx) + (1 / I^zz - 1 / I^xx) (L.n)^2 / 2 + C n.(s n)`.
    NaiveEnergy(x) {
        let (RigidSpheroid { inertia_xx, inertia_zz, constant_c }, momentum) = (body(&x[3..]), vector(x));
        let along = momentum.z;
        let spinning = (S::one() / inertia_zz - S::one() / inertia_xx) * along * along / 2.0;
        vec![momentum.dot(&momentum) / (inertia_xx * 2.0) + spinning + constant_c * x[8]]
    }
    Spin: "first_integrals", (x) {
        let state = AxisState { axis: vector(x), momentum: vector(&x[3..]) };
        vec![first_integrals(&body(&x[6..]), &Matrix3::zeros(), &state).spin]
    }
    Adjugate: "symmetric_adjugate", (x) { entries(&symmetric_adjugate(&symmetric(x))) }
    Clebsch: "FirstIntegrals::clebsch", (x) {
        let state = AxisState { axis: vector(&x[6..]), momentum: vector(&x[9..]) };
        vec![first_integrals(&body(&x[15..]), &symmetric(x), &state).clebsch]
    }
    InertiaAcceleration: "spheroid_inertia_acceleration".composite(), (x) {
        entries(&spheroid_inertia_acceleration(&body(&x[15..]), &symmetric(x), &vector(&x[6..]), &vector(&x[9..])))
    }
    // beta, alpha, rate, body (3)
    FreeWave: "free_inertia_acceleration".beside::<NaiveFreeWave>("sin 2b tan b"), (x) {
        entries(&free_inertia_acceleration(&body(&x[3..]), x[1], x[0], x[2]))
    }
    /// With `sin 2b tan b`, as in Eq. (68).
    NaiveFreeWave(x) {
        let spheroid = body(&x[3..]);
        let (sb, cb) = x[0].sin_cos();
        let (sa, ca) = x[1].sin_cos();
        let tangent = sb / cb;
        let size = (spheroid.inertia_zz - spheroid.inertia_xx) * x[2] * x[2] * sb * cb;
        let (cos_2a, sin_2a) = (ca * ca - sa * sa, sa * ca * 2.0);
        let wide = tangent * 2.0 * size;
        let (xz, yz) = (-(size * sa), size * ca);
        vec![wide * cos_2a, wide * sin_2a, xz, wide * sin_2a, -(wide * cos_2a), yz, xz, yz, S::zero()]
    }
    Body: "RigidSpheroid", (x) {
        let spheroid = body(x);
        vec![spheroid.oblateness(), spheroid.free_precession_constant(x[3]), spheroid.time_unit().unwrap_or(S::from_f64(f64::NAN))]
    }
    // I^xx, I^zz / I^xx, C, Omega^z
    BodyInUnits: "RigidSpheroid".natural_derivatives(), (x) { Body::of(&[x[0], x[0] * x[1], x[2], x[3]]) }
    // theta_o, phi_o, ddot I (6), distance
    Strain: "metric_perturbation, polarizations, polarization_tensors".composite(), (x) {
        let h = polarizations(&Observer::at(x[0], x[1]), &metric_perturbation(x[8], &symmetric(&x[2..])));
        vec![h.plus, h.cross]
    }
}

const SMALL: Input = Signed(-9.0, -0.5);

/// A tensor of the given input and the state and body after it.
const fn with_tensor(s: Input) -> [Input; 18] {
    let (c, i) = (COMPONENT, INERTIA);
    [s, s, s, s, s, s, c, c, c, c, c, c, c, c, c, i, i, i]
}

const TENSOR: [Input; 18] = with_tensor(Signed(-300.0, 0.0));
const ISOTROPIC: [Input; 18] = {
    let mut inputs = with_tensor(Signed(-15.0, -3.0));
    inputs[0] = Near(0.1, -15.0, -1.1);
    inputs[1] = Fixed(0.1);
    inputs[2] = Fixed(0.1);
    inputs
};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let sweeps = [
        ("sin b -> 0 at beta = 0", Log(-300.0, 0.0), Log(-15.0, 0.0)),
        ("sin b -> 0 at beta = pi", Near(PI, -15.0, -0.5), Near(PI, -15.0, -0.5)),
        ("cos b -> 0", Near(FRAC_PI_2, -15.0, -0.3), Near(FRAC_PI_2, -15.0, -0.3)),
    ];
    for (limit, beta, off_pole) in sweeps {
        let sweep = |rest: &[Input]| [&[beta], rest].concat();
        let off_pole = |rest: &[Input]| [&[off_pole], rest].concat();
        let in_angles = sweep(&[TURN, INERTIA, SMALL, SMALL, SMALL]);
        let moving = [TURN, TURN, RATE, RATE, RATE, INERTIA, INERTIA, INERTIA, SMALL, SMALL, SMALL];
        let axis = [TURN, RATE, RATE, RATE, INERTIA, INERTIA, INERTIA, SMALL, SMALL, SMALL];
        cases.extend([
            PotentialInAngles::case(limit, &in_angles),
            Gradient::case(limit, &in_angles),
            TorqueFromGradient::case(limit, &off_pole(&[TURN, COMPONENT, COMPONENT, COMPONENT])),
            KineticEnergy::case(limit, &sweep(&moving)),
            EnergyInAngles::case(limit, &sweep(&moving)),
            Accelerations::case(limit, &off_pole(&axis)),
            Residuals::case(limit, &sweep(&[&axis[..], &[RATE, RATE]].concat())),
            FreeWave::case(limit, &sweep(&[TURN, RATE, INERTIA, INERTIA, Fixed(1.0)])),
        ]);
    }
    for (limit, inputs) in [("s from 1e-300 to 1", &TENSOR), ("equal and nearly equal eigenvalues", &ISOTROPIC)] {
        cases.extend([
            PotentialOfAxis::case(limit, &inputs[..10]),
            TorqueOnAxis::case(limit, &inputs[..10]),
            PotentialOfBody::case(limit, &inputs[..12]),
            TorqueOnBody::case(limit, &inputs[..12]),
            ReducedRates::case(limit, inputs),
            StateRates::case(limit, inputs),
            Integrals::case(limit, inputs),
            Clebsch::case(limit, inputs),
            Adjugate::case(limit, &inputs[..6]),
            InertiaAcceleration::case(limit, inputs),
        ]);
    }
    cases.extend([
        Energy::case(
            "L along n, I^zz -> infinity",
            &list![Signed(-12.0, 0.0); 2, RATE, INERTIA, Log(0.0, 20.0), INERTIA, Fixed(0.0); 2, SMALL, Fixed(0.0); 3],
        ),
        Spin::case(
            "Omega^z -> 0, L normal to n",
            &list![Signed(-300.0, 0.0), COMPONENT, Fixed(0.0), COMPONENT, Signed(-300.0, 0.0), COMPONENT, INERTIA; 3],
        ),
        Acceleration::case(
            "rates from 1e-100 to 1e100",
            &list![Signed(-100.0, 100.0), RATE; 2, COMPONENT; 3, INERTIA; 3],
        ),
        WaveTensor::case(
            "rates from 1e-100 to 1e100",
            &list![Signed(-100.0, 100.0), RATE; 2, COMPONENT; 3, INERTIA; 3],
        ),
        WaveTensor::case("equal moments of inertia", &list![RATE; 3, SMALL; 3, Near(1.0, -15.5, -0.5); 2, Fixed(1.0)]),
        Differences::case("equal moments of inertia", &[Near(1.0, -15.5, -0.5), Near(1.0, -15.5, -0.5), Fixed(1.0)]),
        EnergyOfBody::case("rates from 1e-100 to 1e100", &list![Signed(-100.0, 100.0), RATE; 2, INERTIA; 3]),
        Body::case("I^zz -> I^xx", &[Near(1.0, -15.5, -0.1), Fixed(1.0), Log(-20.0, 20.0), Signed(-300.0, 3.0)]),
        BodyInUnits::case(
            "units from 1e-100 to 1e100",
            &[Log(-100.0, 100.0), In(0.2, 2.0), Log(-100.0, 100.0), Signed(-50.0, 50.0)],
        ),
        Nordtvedt::case("alpha_2 from 1e-200 to 1", &list![Signed(-200.0, 0.0), Log(-10.0, 10.0), COMPONENT; 6]),
        PotentialOfMasses::case(
            "distances from 1e-100 to 1e100",
            &list![SMALL; 6, INERTIA; 2, Log(-100.0, 100.0), COMPONENT; 3],
        ),
        PreferredFrameOfMasses::case(
            "alpha_2 from 1e-200 to 1",
            &list![Signed(-200.0, 0.0), COMPONENT; 3, INERTIA; 3, COMPONENT; 3],
        ),
        FromPreferredFrame::case("alpha_2 from 1e-200 to 1", &list![Signed(-200.0, 0.0), Signed(-5.0, -2.0); 3]),
        PreferredFrameParameter::case("alpha_2 from 1e-200 to 1", &list![Signed(-200.0, 0.0), Signed(-5.0, -2.0); 3]),
        Strain::case("theta_o -> 0", &list![Log(-300.0, 0.4), TURN, COMPONENT; 6, Log(-20.0, 20.0)]),
        Strain::case("theta_o -> pi", &list![Near(PI, -15.0, -0.3), TURN, COMPONENT; 6, Log(-20.0, 20.0)]),
    ]);
    cases
}
