//! Rotations, Euler angles and the tensor `s^IJ` at random points of their domains, by proptest with a fixed seed.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use twofold::Error;
use twofold::euler_angles::{
    EulerAngles, EulerRates, angles_from_rotation, body_from_inertial, body_rates, euler_rates,
};
use twofold::lorentz_violation::{
    PrincipalCoefficients, coefficients_from_preferred_frame, preferred_frame_parameter, principal_frame,
};
use twofold::numerics::angle::wrapped;
use twofold_verify::check::largest;

const EPS: f64 = f64::EPSILON;

fn config() -> ProptestConfig {
    ProptestConfig { cases: 500, rng_seed: RngSeed::Fixed(61), failure_persistence: None, ..ProptestConfig::default() }
}

/// Inclinations over the whole sphere, half of them close to a pole, down to 1e-8.
fn inclinations() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => 0.05..PI - 0.05,
        1 => (-8.0..-1.0f64).prop_map(|log| 10f64.powf(log)),
        1 => (-8.0..-1.0f64).prop_map(|log| PI - 10f64.powf(log)),
    ]
}

fn orientations() -> impl Strategy<Value = EulerAngles<f64>> {
    (-PI..PI, inclinations(), -PI..PI).prop_map(|(alpha, beta, gamma)| EulerAngles { alpha, beta, gamma })
}

fn rates() -> impl Strategy<Value = EulerRates<f64>> {
    prop::array::uniform3(-3.0..3.0f64).prop_map(|[alpha, beta, gamma]| EulerRates { alpha, beta, gamma })
}

/// Three eigenvalues of any sign and size, some of them equal or nearly so.
fn eigenvalues() -> impl Strategy<Value = [f64; 3]> {
    (prop::array::uniform3(-1.0..1.0f64), -12.0..0.0f64, 0..4u8, -16.0..-8.0f64).prop_map(|(x, size, shape, gap)| {
        let [a, b, c] = x.map(|v| v * 10f64.powf(size));
        match shape {
            0 => [a, a, c],
            1 => [a, a * (1.0 + 10f64.powf(gap)), c],
            2 => [a, a, a],
            _ => [a, b, c],
        }
    })
}

fn departure_from_rotation(r: &Matrix3<f64>) -> f64 {
    let handed = r.row(0).cross(&r.row(1)) - r.row(2);
    largest((r * r.transpose() - Matrix3::identity()).iter().chain(handed.iter()).map(|x: &f64| x.abs()))
}

proptest! {
    #![proptest_config(config())]

    /// Angles -> rotation -> angles: the small `sin beta` cancels in the ratios of the arc tangents, so that the errors are
    /// a few roundings of numbers up to pi, also near the poles.
    #[test]
    fn angles_come_back_from_the_rotation(angles in orientations()) {
        let back = angles_from_rotation(&body_from_inertial(&angles)).unwrap();
        prop_assert!(wrapped(back.alpha - angles.alpha).abs() <= 8.0 * EPS, "{back:?}");
        prop_assert!((back.beta - angles.beta).abs() <= 8.0 * EPS, "{back:?}");
        prop_assert!(wrapped(back.gamma - angles.gamma).abs() <= 8.0 * EPS, "{back:?}");
    }

    /// Rotation -> angles -> rotation, for a matrix with rounded entries: `alpha` and `gamma` are known to `eps / sin beta`.
    #[test]
    fn the_rotation_comes_back_from_its_angles(a in orientations(), b in orientations()) {
        let rotation = body_from_inertial(&a) * body_from_inertial(&b).transpose();
        let angles = angles_from_rotation(&rotation).unwrap();
        prop_assert!((0.0..=PI).contains(&angles.beta));
        let error = largest((body_from_inertial(&angles) - rotation).iter().map(|x: &f64| x.abs()));
        prop_assert!(error <= 8.0 * EPS / angles.beta.sin(), "{error:e}");
    }

    /// Rates -> angular velocity -> rates: a rounding of `b'` appears in `a'` divided by `sin beta`.
    #[test]
    fn rates_come_back_from_the_angular_velocity(angles in orientations(), rates in rates()) {
        let back = euler_rates(&angles, &body_rates(&angles, &rates)).unwrap();
        let sin_beta = angles.beta.sin();
        let of_alpha = 4.0 * EPS * (rates.alpha.abs() + rates.beta.abs() / sin_beta);
        prop_assert!((back.alpha - rates.alpha).abs() <= of_alpha);
        prop_assert!((back.beta - rates.beta).abs() <= 4.0 * EPS * (rates.beta.abs() + rates.alpha.abs() * sin_beta));
        prop_assert!((back.gamma - rates.gamma).abs() <= of_alpha + 4.0 * EPS * (rates.gamma.abs() + rates.alpha.abs()));
    }

    /// Eigenvalues and frame -> tensor -> eigenvalues and frame, equal eigenvalues included.
    #[test]
    fn the_principal_frame_comes_back_from_the_tensor(given in orientations(), values in eigenvalues()) {
        let given = body_from_inertial(&given);
        let product = given.transpose() * PrincipalCoefficients::new(values).tensor() * given;
        let tensor = (product + product.transpose()) * 0.5;
        let size = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let frame = principal_frame(&tensor).unwrap();
        let (q, s) = (frame.principal_from_given, frame.coefficients);
        let mut descending = values;
        descending.sort_by(|x, y| y.total_cmp(x));
        prop_assert!(departure_from_rotation(&q) <= 16.0 * EPS);
        for (found, expected) in [s.xx, s.yy, s.zz].into_iter().zip(descending) {
            prop_assert!((found - expected).abs() <= 16.0 * EPS * size, "{found:e} {expected:e}");
        }
        prop_assert!(largest((q * tensor * q.transpose() - s.tensor()).iter().map(|x: &f64| x.abs())) <= 16.0 * EPS * size);
        prop_assert!(largest((q.transpose() * s.tensor() * q - tensor).iter().map(|x: &f64| x.abs())) <= 16.0 * EPS * size);
        prop_assert!(largest((tensor * q.row(2).transpose() - q.row(2).transpose() * s.zz).iter().map(|x: &f64| x.abs())) <= 16.0 * EPS * size);
    }

    /// Arbitrary numbers, including infinities and subnormals: a result with a rotation, or an error.
    #[test]
    fn no_tensor_makes_the_principal_frame_panic(x in prop::array::uniform6(prop::num::f64::ANY)) {
        let [xx, yy, zz, xy, xz, yz] = x;
        if let Ok(frame) = principal_frame(&Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)) {
            let s = frame.coefficients;
            prop_assert!(s.xx >= s.yy && s.yy >= s.zz, "{frame:?}");
            prop_assert!(departure_from_rotation(&frame.principal_from_given) <= 16.0 * EPS, "{frame:?}");
        }
    }

    /// PPN replacement, Eq. (5), in both directions; a tensor of another form is refused.
    #[test]
    fn the_preferred_frame_parameter_comes_back(
        alpha_2 in -1e-3..1e-3f64,
        w in prop::array::uniform3(-1e-2..1e-2f64),
    ) {
        let w = Vector3::from(w);
        let tensor = coefficients_from_preferred_frame(alpha_2, &w);
        let back = preferred_frame_parameter(&tensor, &w).unwrap();
        prop_assert!((back - alpha_2).abs() <= 8.0 * EPS * alpha_2.abs());
        let other = tensor + Matrix3::identity() * tensor.amax();
        let refused = matches!(preferred_frame_parameter(&other, &w), Err(Error::Domain { .. }));
        prop_assert!(refused);
    }
}

#[test]
fn the_replacement_has_the_sign_of_the_paper() {
    let tensor = coefficients_from_preferred_frame(2.0, &Vector3::new(0.0, 0.0, 1.0));
    assert_eq!(tensor, Matrix3::from_diagonal(&Vector3::new(-0.0, -0.0, -2.0)));
}
