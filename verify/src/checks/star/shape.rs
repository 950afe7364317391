//! Shapes: oblateness, the appendix's expansions, the domain of the constructors.

use proptest::prelude::*;

use super::unit_spheroid;
use crate::prelude::*;

checks! {
    /// (I^zz - I^xx) / I^xx is e^2 / (2 - e^2), and a spheroid built from this oblateness has it
    Property "star-oblateness" [19, 72, 79]: oblateness;
    AtMost(8.0) "largest error / 2.2e-16";
    because "the difference of two inertias of order one, each to three roundings";
    /// a spheroid built from mass and mean radius has these, and the C of one built from its semi-axes
    Property "star-mass-and-radius" [10, 75]: mass_and_radius;
    AtMost(32.0) "largest relative error / 2.2e-16, that of C x min(1, |e^2|)";
    because "a3 is known to an ulp, so e^2 to an ulp of one; C is of the fifth order in the lengths";
    /// the appendix's expansions have remainders O(e^4), those of A_1 and A_3 (printed O(e^2)) included
    Regime "star-appendix-remainders" [74, 75]: appendix_remainders;
    Within(3.98, 4.02) "the measured order farthest from 4, of A_0, A_1, A_3, C between e = 0.025 and 0.05";
    because "the next term changes the order by about e^2 = 0.003; an order 2 would show";
    /// shapes outside the domain are refused; inside it 0 < A_i < 2 whatever the axis ratio
    Property "star-domain" [72, 74]: domain;
    AtMost(0.0) "number of violations";
    because "a count";
}

fn axis_ratio() -> impl Strategy<Value = f64> {
    (-1.0..1.0f64).prop_map(|log| 10f64.powf(log))
}

fn oblateness() -> Result<Measured, String> {
    worst_over(41, 400, &axis_ratio(), |&q| {
        let spheroid = unit_spheroid(q)?;
        let i = spheroid.moment_of_inertia();
        let epsilon = spheroid.shape.oblateness();
        let again = SpheroidShape::from_oblateness(epsilon)?.oblateness();
        Ok(largest([(i.zz - i.xx) / i.xx - epsilon, again - epsilon].map(f64::abs)) / f64::EPSILON)
    })
}

fn mass_and_radius() -> Result<Measured, String> {
    worst_over(42, 400, &(axis_ratio(), 0.1..10.0f64, 0.1..10.0f64), |&(q, mass, radius)| {
        let build = || {
            let shape = SpheroidShape::from_axis_ratio(q)?;
            let star = UniformSpheroid::from_mass(mass, radius, shape)?;
            let again = UniformSpheroid::from_semi_axes(star.equatorial_radius, star.polar_radius(), star.density)?;
            let e2 = shape.eccentricity_squared().abs().min(1.0);
            let errors = [
                star.mass() / mass - 1.0,
                star.mean_radius() / radius - 1.0,
                again.mass() / mass - 1.0,
                (again.c() / star.c() - 1.0) * e2,
            ];
            Ok(largest(errors.map(f64::abs)) / f64::EPSILON)
        };
        build()
    })
}

/// Remainders of A_0, A_1, A_3 (units of the leading term) and of C / (16 pi^2 a3 / 225) after the terms in `e^2`.
fn remainders(e: f64) -> Result<[f64; 4], String> {
    let shape = SpheroidShape::from_eccentricity(e)?;
    let a = potential_coefficients(&shape);
    let c = UniformSpheroid::new(1.0, 1.0, shape)?.c();
    let e2 = e * e;
    Ok([
        a.a0 / 2.0 - (1.0 - e2 / 3.0),
        a.a1 * 1.5 - (1.0 - e2 / 5.0),
        a.a3 * 1.5 - (1.0 + e2 * 0.4),
        c / (16.0 * PI * PI / 225.0 * shape.axis_ratio()) - e2,
    ])
}

fn appendix_remainders() -> Result<Measured, String> {
    let (coarse, fine) = (remainders(0.05)?, remainders(0.025)?);
    let orders = [0, 1, 2, 3].map(|i| (coarse[i] / fine[i]).log2());
    let farthest = orders.into_iter().fold(4.0, |far: f64, order| {
        if order.is_nan() || (order - 4.0).abs() > (far - 4.0).abs() { order } else { far }
    });
    Ok(Measured::new(farthest, format!("orders of A_0, A_1, A_3, C: {orders:.4?}")))
}

fn domain() -> Result<Measured, String> {
    let refused = [
        SpheroidShape::from_eccentricity(1.0).is_err(),
        SpheroidShape::from_eccentricity(-0.1).is_err(),
        SpheroidShape::from_eccentricity(f64::NAN).is_err(),
        SpheroidShape::from_eccentricity_squared(1.0).is_err(),
        SpheroidShape::from_eccentricity_squared(f64::NEG_INFINITY).is_err(),
        SpheroidShape::from_axis_ratio(0.0).is_err(),
        SpheroidShape::from_axis_ratio(f64::INFINITY).is_err(),
        SpheroidShape::from_oblateness(1.0).is_err(),
        SpheroidShape::from_oblateness(f64::NAN).is_err(),
        SpheroidShape::from_semi_axes(1.0, -1.0).is_err(),
        SpheroidShape::from_semi_axes(f64::INFINITY, f64::INFINITY).is_err(),
        UniformSpheroid::from_semi_axes(1.0, 1.0, 0.0).is_err(),
        unit_spheroid(1.0)?.polar_inertia_over_c().is_err(),
        unit_spheroid(2.0)?.time_unit().is_err(),
        unit_spheroid(0.5)?.time_unit().is_ok(),
        unit_spheroid(1.0)?.c() == 0.0,
        unit_spheroid(2.0)?.c() < 0.0,
    ];
    let mut worst = Worst::default();
    let wrong = refused.iter().filter(|&&right| !right).count();
    worst.see(wrong as f64, || format!("{refused:?}"));
    for log in -100..=100 {
        let a = potential_coefficients(&unit_spheroid(10f64.powi(log).clamp(1e-100, 1e100))?.shape);
        // A_1 of a needle and A_3 of a disc round to their limits 1 and 2.
        let inside = a.a0 > 0.0 && a.a1 > 0.0 && a.a1 <= 1.0 && a.a3 > 0.0 && a.a3 <= 2.0;
        worst.see(f64::from(u8::from(!inside)), || format!("a3/a1 = 1e{log}: {a:?}"));
    }
    worst.finish()
}
