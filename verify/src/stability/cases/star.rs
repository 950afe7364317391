//! Uniform spheroids and ellipsoids.

use twofold::star::axisymmetric::axisymmetric_integrals;
use twofold::star::ellipsoid::UniformEllipsoid;
use twofold::star::potential_coefficients::reduced_difference;

use super::parts::*;

/// Semi-axis ratio, its square and the squared eccentricity, to 31 digits.
fn by_e<S: Real>(e: S) -> [S; 3] {
    let q2 = (S::one() - e) * (S::one() + e);
    [q2.sqrt(), q2, e * e]
}

fn by_q<S: Real>(q: S) -> [S; 3] {
    [q, q * q, (S::one() - q) * (S::one() + q)]
}

fn by_e2<S: Real>(e2: S) -> [S; 3] {
    [(S::one() - e2).sqrt(), S::one() - e2, e2]
}

fn by_epsilon<S: Real>(epsilon: S) -> [S; 3] {
    let sum = S::one() + epsilon;
    let q2 = (S::one() - epsilon) / sum;
    [q2.sqrt(), q2, epsilon * 2.0 / sum]
}

fn shape<S: Real>(shape: &SpheroidShape<S>) -> Vec<S> {
    vec![shape.axis_ratio(), shape.axis_ratio_squared(), shape.eccentricity_squared(), shape.oblateness()]
}

fn exact_shape<S: Real>([q, q2, e2]: [S; 3]) -> Vec<S> {
    vec![q, q2, e2, exact_oblateness(q2, e2)]
}

fn exact_oblateness<S: Real>(q2: S, e2: S) -> S {
    if q2.re() > 1e3 { S::from_f64(2.0) / (q2 + S::one()) - S::one() } else { e2 / (q2 + S::one()) }
}

fn coefficients<S: Real>(shape: &SpheroidShape<S>) -> Vec<S> {
    let a = potential_coefficients(shape);
    vec![a.a0, a.a1, a.a3, a.difference, reduced_difference(shape)]
}

fn exact_coefficients<S: Real>([q, q2, e2]: [S; 3]) -> Vec<S> {
    let mut all = oracle::potential_coefficients(q, q2, e2).to_vec();
    all.push(oracle::reduced_difference(q, q2, e2));
    all
}

/// Eq. (74) as printed.
fn printed_coefficients<S: Real>(e: S) -> Vec<S> {
    let q = (S::one() - e * e).sqrt();
    let arc = e.atan2(q) / e;
    let a1 = q / (e * e) * (arc - q);
    let a3 = (S::one() - q * arc) * 2.0 / (e * e);
    let difference = a1 - q * q * a3;
    vec![q * arc * 2.0, a1, a3, difference, difference / (q * e * e)]
}

fn exact_c<S: Real>([q, q2, e2]: [S; 3], a1: S, density: S) -> S {
    let a = density * a1 * a1;
    q2 * e2 * oracle::reduced_difference(q, q2, e2) * pi::<S>() * pi::<S>() * ratio::<S>(4.0, 15.0) * a * a * a1
}

fn spheroid<S: Real>(body: &UniformSpheroid<S>) -> Vec<S> {
    let (inertia, energy) = (body.moment_of_inertia(), body.potential_energy_tensor());
    vec![
        body.polar_radius(),
        body.mass(),
        inertia.xx,
        inertia.zz,
        energy.xx,
        energy.zz,
        body.c(),
        body.shape.oblateness(),
        body.mean_radius(),
    ]
}

fn exact_spheroid<S: Real>([q, q2, e2]: [S; 3], a1: S, density: S) -> Vec<S> {
    let [_, c1, c3, _] = oracle::potential_coefficients(q, q2, e2);
    let volume = a1 * a1 * a1 * q * pi::<S>() * ratio::<S>(4.0, 3.0);
    let mass = density * volume;
    let xx = mass * a1 * a1 / 5.0;
    let two_pi_rho = density * pi::<S>() * 2.0;
    vec![
        a1 * q,
        mass,
        xx + xx * q2,
        xx * 2.0,
        two_pi_rho * c1 * xx,
        two_pi_rho * c3 * xx * q2,
        exact_c([q, q2, e2], a1, density),
        exact_oblateness(q2, e2),
        a1 * cube_root(q),
    ]
}

/// Cube root by Newton's method from the double.
fn cube_root<S: Real>(x: S) -> S {
    let mut root = S::from_f64(x.re().cbrt());
    for _ in 0..4 {
        root = (root * 2.0 + x / (root * root)) / 3.0;
    }
    root
}

functions! {
    ShapeByE: "SpheroidShape::from_eccentricity".against::<ExactShapeByE>(), (x) {
        SpheroidShape::from_eccentricity(x[0]).map_or(none(4), |s| shape(&s))
    }
    ExactShapeByE(x) { exact_shape(by_e(x[0])) }
    NaiveShapeByE(x) {
        let q = (S::one() - x[0] * x[0]).sqrt();
        let e2 = S::one() - q * q;
        vec![q, q * q, e2, e2 / (S::one() + S::one() - e2)]
    }
    ShapeByE2: "SpheroidShape::from_eccentricity_squared".against::<ExactShapeByE2>(), (x) {
        shape(&SpheroidShape::from_eccentricity_squared(x[0]).expect("a shape"))
    }
    ExactShapeByE2(x) { exact_shape(by_e2(x[0])) }
    ShapeByQ: "SpheroidShape::from_axis_ratio".against::<ExactShapeByQ>(), (x) {
        shape(&SpheroidShape::from_axis_ratio(x[0]).expect("a shape"))
    }
    ExactShapeByQ(x) { exact_shape(by_q(x[0])) }
    NaiveShapeByQ(x) {
        let e2 = S::one() - x[0] * x[0];
        vec![x[0], x[0] * x[0], e2, e2 / (S::one() + S::one() - e2)]
    }
    ShapeByEpsilon: "SpheroidShape::from_oblateness".against::<ExactShapeByEpsilon>(), (x) {
        shape(&SpheroidShape::from_oblateness(x[0]).expect("a shape"))
    }
    ExactShapeByEpsilon(x) { exact_shape(by_epsilon(x[0])) }
    // a3, a1
    ShapeByAxes: "UniformSpheroid::from_semi_axes".against::<ExactShapeByAxes>().composite(), (x) {
        let body = UniformSpheroid::from_semi_axes(x[1], x[0], S::one()).expect("a spheroid");
        shape(&body.shape)
    }
    ExactShapeByAxes(x) {
        let q = x[0] / x[1];
        let e2 = (x[1] - x[0]) * (x[1] + x[0]) / (x[1] * x[1]);
        exact_shape([q, q * q, e2])
    }
    CoefficientsByE: "potential_coefficients, reduced_difference"
        .against::<ExactCoefficientsByE>().beside::<PrintedCoefficientsByE>("Eq. (74) as printed"), (x) {
        coefficients(&SpheroidShape::from_eccentricity(x[0]).expect("a shape"))
    }
    ExactCoefficientsByE(x) { exact_coefficients(by_e(x[0])) }
    PrintedCoefficientsByE(x) { printed_coefficients(x[0]) }
    CoefficientsByE2: "potential_coefficients, reduced_difference".against::<ExactCoefficientsByE2>(), (x) {
        coefficients(&SpheroidShape::from_eccentricity_squared(x[0]).expect("a shape"))
    }
    ExactCoefficientsByE2(x) { exact_coefficients(by_e2(x[0])) }
    CoefficientsByQ: "potential_coefficients, reduced_difference".against::<ExactCoefficientsByQ>(), (x) {
        coefficients(&SpheroidShape::from_axis_ratio(x[0]).expect("a shape"))
    }
    ExactCoefficientsByQ(x) { exact_coefficients(by_q(x[0])) }
    SpheroidByE: "UniformSpheroid::new".against::<ExactSpheroidByE>().composite(), (x) {
        let shape = SpheroidShape::from_eccentricity(x[0]).expect("a shape");
        spheroid(&UniformSpheroid::new(x[1], x[2], shape).expect("a spheroid"))
    }
    ExactSpheroidByE(x) { exact_spheroid(by_e(x[0]), x[1], x[2]) }
    SpheroidByQ: "UniformSpheroid::new".against::<ExactSpheroidByQ>().composite(), (x) {
        let shape = SpheroidShape::from_axis_ratio(x[0]).expect("a shape");
        spheroid(&UniformSpheroid::new(x[1], x[2], shape).expect("a spheroid"))
    }
    ExactSpheroidByQ(x) { exact_spheroid(by_q(x[0]), x[1], x[2]) }
    Periods: "UniformSpheroid: polar_inertia_over_c, time_unit".against::<ExactPeriods>().composite(), (x) {
        let shape = SpheroidShape::from_eccentricity(x[0]).expect("a shape");
        let body = UniformSpheroid::new(S::one(), x[1], shape).expect("a spheroid");
        vec![body.polar_inertia_over_c().expect("oblate"), body.time_unit().expect("oblate")]
    }
    ExactPeriods(x) {
        let [q, q2, e2] = by_e(x[0]);
        let [.., difference] = oracle::potential_coefficients(q, q2, e2);
        let ratio = S::from_f64(2.0) / (x[1] * pi::<S>() * difference);
        vec![ratio, (ratio * (S::one() + q2) / 2.0).sqrt()]
    }
    FromMass: "UniformSpheroid::from_mass".against::<ExactFromMass>().composite(), (x) {
        let shape = SpheroidShape::from_axis_ratio(x[0]).expect("a shape");
        let body = UniformSpheroid::from_mass(x[1], x[2], shape).expect("a spheroid");
        vec![body.equatorial_radius, body.polar_radius()]
    }
    ExactFromMass(x) {
        let radius = x[2];
        vec![radius / cube_root(x[0]), radius / cube_root(x[0]) * x[0]]
    }
    /// Mass, mean radius and density of a spheroid from mass and mean radius.
    MassOf: "UniformSpheroid: from_mass, mean_radius".against::<ExactMassOf>().composite().values_only(), (x) {
        let shape = SpheroidShape::from_axis_ratio(x[0]).expect("a shape");
        let body = UniformSpheroid::from_mass(x[1], x[2], shape).expect("a spheroid");
        vec![body.mass(), body.mean_radius(), body.density]
    }
    ExactMassOf(x) {
        vec![x[1], x[2], x[1] * ratio::<S>(3.0, 4.0) / (pi::<S>() * x[2] * x[2] * x[2])]
    }
    Maclaurin: "MaclaurinSpheroid".against::<ExactMaclaurin>().composite(), (x) {
        let shape = SpheroidShape::from_eccentricity(x[0]).expect("a shape");
        let body = MaclaurinSpheroid::new(UniformSpheroid::new(x[1], x[2], shape).expect("a spheroid")).expect("oblate");
        vec![
            body.rotation_rate_squared,
            body.rotational_energy,
            body.kinetic_tensor.xx,
            body.central_pressure,
            body.pressure_integral,
            body.pressure(x[3] * x[1], S::zero()),
        ]
    }
    ExactMaclaurin(x) {
        let [q, q2, e2] = by_e(x[0]);
        let [_, _, c3, difference] = oracle::potential_coefficients(q, q2, e2);
        let (a1, density) = (x[1], x[2]);
        let square = density * pi::<S>() * 2.0 * difference;
        let volume = a1 * a1 * a1 * q * pi::<S>() * ratio::<S>(4.0, 3.0);
        let moment = density * volume * a1 * a1 / 5.0;
        let pressure = pi::<S>() * density * density * c3 * a1 * a1 * q2;
        vec![
            square,
            moment * square,
            moment * square,
            pressure,
            pressure * volume * ratio::<S>(2.0, 5.0),
            pressure * (S::one() - x[3]) * (S::one() + x[3]),
        ]
    }
    Ellipsoid: "UniformEllipsoid".against::<ExactEllipsoid>().composite(), (x) {
        let body = UniformEllipsoid::new(Vector3::new(x[1], x[2], x[0]), x[3]).expect("an ellipsoid");
        let (a, u, i) = (body.coefficients(), body.potential_energy_tensor(), body.moments_of_inertia());
        vec![body.mass(), body.central_coefficient(), a.x, a.y, a.z, u.x, u.y, u.z, i.x, i.y, i.z]
    }
    ExactEllipsoid(x) {
        let (a, density) = ([x[1], x[2], x[0]], x[3]);
        let [p, q, r] = a.map(|a| a * a);
        let product = a[0] * a[1] * a[2];
        let mass = density * product * pi::<S>() * ratio::<S>(4.0, 3.0);
        let coefficients = [oracle::rd(q, r, p), oracle::rd(r, p, q), oracle::rd(p, q, r)].map(|rd| rd * product * ratio::<S>(2.0, 3.0));
        let [mx, my, mz] = [p, q, r].map(|square| mass * square / 5.0);
        let factor = density * pi::<S>() * 2.0;
        let [cx, cy, cz] = coefficients;
        vec![
            mass, product * oracle::rf(p, q, r) * 2.0, cx, cy, cz, factor * cx * mx, factor * cy * my, factor * cz * mz,
            my + mz, mz + mx, mx + my,
        ]
    }
    Multipoles: "axisymmetric_integrals", (x) {
        let shape = SpheroidShape::from_eccentricity(x[0]).expect("a shape");
        let star = UniformSpheroid::new(S::one(), S::one(), shape).expect("a star");
        axisymmetric_integrals(&star, 4).map_or(none(6), |all| {
            let (i, u) = (all.moment_of_inertia, all.potential_energy_tensor);
            vec![all.mass, i.xx, i.zz, u.xx, u.zz, all.c]
        })
    }
    Estimates: "inertia_over_c_estimate, time_unit_estimate".against::<ExactEstimates>(), (x) {
        vec![inertia_over_c_estimate(x[1], x[0]), time_unit_estimate(x[1], x[0]).expect("oblate")]
    }
    ExactEstimates(x) {
        let estimate = S::from_f64(15.0) / (pi::<S>() * x[1] * x[0] * 4.0);
        vec![estimate, estimate.sqrt()]
    }
    Deformation: "centrifugal_oblateness", (x) { vec![centrifugal_oblateness(x[0], x[1], x[2])] }
    DeformationScaled: "centrifugal_oblateness_scaled, CENTRIFUGAL_COEFFICIENT"
        .against::<ExactDeformationScaled>(), (x) {
        vec![centrifugal_oblateness_scaled(x[0], x[1], x[2])]
    }
    ExactDeformationScaled(x) {
        let (omega, radius) = (pi::<S>() * x[0] * 2.0, x[1] * 1000.0);
        vec![omega * omega * radius * radius * radius / (x[2] * si::SOLAR_MASS_PARAMETER)]
    }
}

pub(super) fn cases() -> Vec<Case> {
    vec![
        ShapeByE::case("e -> 0", &[Log(-12.0, -0.01)]).beside::<NaiveShapeByE>("e^2 from q"),
        ShapeByE::case("e -> 1", &[Below(1.0, -15.5, -0.3)]).beside::<NaiveShapeByE>("q^2 = 1 - e e"),
        ShapeByE2::case("e^2 -> 0, both signs", &[Signed(-300.0, -0.1)]),
        ShapeByE2::case("e^2 -> 1", &[Below(1.0, -15.5, -0.3)]),
        ShapeByQ::case("sphere, q -> 1, both sides", &[Near(1.0, -15.5, -0.3)]).beside::<NaiveShapeByQ>("1 - q q"),
        ShapeByQ::case("disc to needle, q from 1e-100 to 1e100", &[Log(-99.9, 99.9)]),
        ShapeByEpsilon::case("oblateness -> 0, both signs", &[Signed(-300.0, -0.01)]),
        ShapeByEpsilon::case("oblateness -> 1", &[Below(1.0, -15.5, -0.3)]),
        ShapeByAxes::case("a3 -> a1", &[Near(1.0, -15.5, -0.3), In(0.9, 1.1)]),
        CoefficientsByE::case("e -> 0", &[Log(-12.0, -0.01)]),
        CoefficientsByE::case("e -> 1", &[Below(1.0, -15.5, -0.3)]),
        CoefficientsByE2::case("e^2 -> 0, both signs", &[Signed(-300.0, -0.1)]),
        CoefficientsByQ::case("sphere, q -> 1, both sides", &[Near(1.0, -15.5, -0.3)]),
        CoefficientsByQ::case("disc to needle, q from 1e-50 to 1e50", &[Log(-49.9, 49.9)]),
        SpheroidByE::case("e -> 0", &[Log(-12.0, -0.01), In(0.5, 2.0), In(0.5, 2.0)]),
        SpheroidByE::case("e -> 1", &[Below(1.0, -15.5, -0.3), In(0.5, 2.0), In(0.5, 2.0)]),
        SpheroidByQ::case("prolate, q -> 1 and beyond", &[Above(1.0, -15.5, 3.0), In(0.5, 2.0), In(0.5, 2.0)]),
        SpheroidByE::case(
            "units: a1 from 1e-30 to 1e30, rho from 1e-40 to 1e40",
            &[In(0.1, 0.9), Log(-30.0, 30.0), Log(-40.0, 40.0)],
        ),
        Periods::case("e -> 0", &[Log(-12.0, -0.01), Log(-10.0, 10.0)]),
        FromMass::case("disc to needle, q from 1e-90 to 1e90", &[Log(-90.0, 90.0), In(0.5, 2.0), In(0.5, 2.0)]),
        MassOf::case(
            "mass and mean radius there and back, q from 1e-90 to 1e90",
            &[Log(-90.0, 90.0), In(0.5, 2.0), In(0.5, 2.0)],
        ),
        Maclaurin::case("e -> 0", &[Log(-12.0, -0.01), In(0.5, 2.0), In(0.5, 2.0), In(0.0, 0.9)]),
        Maclaurin::case("e -> 1", &[Below(1.0, -15.5, -0.3), In(0.5, 2.0), In(0.5, 2.0), In(0.0, 0.9)]),
        Ellipsoid::case("one axis -> 0 and to infinity", &[Log(-12.0, 12.0), In(0.5, 2.0), In(0.5, 2.0), In(0.5, 2.0)])
            .natural_derivatives(),
        Ellipsoid::case(
            "sphere: all axes -> 1",
            &[Near(1.0, -15.5, -1.0), Near(1.0, -15.5, -1.0), Fixed(1.0), In(0.5, 2.0)],
        ),
        Estimates::case("oblateness -> 0", &[Log(-60.0, 0.0), Log(-60.0, 60.0)]),
        Deformation::case("rate -> 0 and large, any units", &[Log(-60.0, 60.0), Log(-40.0, 40.0), Log(-40.0, 40.0)]),
        DeformationScaled::case("frequency from 1e-5 to 1e5 Hz", &[Log(-5.0, 5.0), In(5.0, 20.0), In(0.5, 3.0)]),
        Multipoles::case("sphere, e -> 0: rounding of the quadrature of degree 4", &[Log(-8.0, -0.1)])
            .except(
                1e15,
                "C of nearly a sphere is what is left of integrals over the whole star: condition number \
e^-2. `UniformSpheroid::c` is regular.",
            )
            .derivatives_except(1e15, "As for the value.")
            .with_points(2),
    ]
}
