//! Derivatives of order up to eight, by nested dual numbers: series are correct to their last term, and rotations stay rotations.

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual2_64, Dual3, Dual3_64, Dual64, DualNum};
use twofold::euler_angles::{EulerAngles, body_from_inertial};
use twofold::lorentz_violation::{
    PrincipalCoefficients, principal_frame, principal_frame_along, principal_frame_with_derivatives,
};
use twofold::solutions::free::rotated_by;

/// Eight derivatives by one variable: three, three and two of them.
type Third = Dual3<Dual2_64>;
type Eighth = Dual3<Third>;

fn eighth(value: f64) -> Eighth {
    let inner = Dual2_64::from_re(value).derivative();
    let middle = Third::from_re(inner).derivative();
    Eighth::from_re(middle).derivative()
}

/// Largest magnitude; NaN if one is NaN.
fn larger(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, v| if v.is_nan() || most.is_nan() { f64::NAN } else { most.max(v.abs()) })
}

/// Largest of all derivatives.
fn largest(x: Eighth) -> f64 {
    let outer = [x.re, x.v1, x.v2, x.v3];
    let inner = outer.iter().flat_map(|y| [y.re, y.v1, y.v2, y.v3]);
    larger(inner.flat_map(|z| [z.re, z.v1, z.v2]))
}

#[test]
fn small_rotations_have_eight_derivatives() {
    let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    let v = Vector3::new(0.3, 0.8, -0.5);
    for angle in [0.0, 1e-5, 0.009, -0.009, 0.3, 1.3] {
        let t = eighth(angle);
        let constant = |v: &Vector3<f64>| v.map(Eighth::from);
        let found = rotated_by(&(constant(&axis) * t), &constant(&v));
        let (sin, cos) = t.sin_cos();
        let along = axis * axis.dot(&v);
        let exact = constant(&(v - along)) * cos + constant(&axis.cross(&v)) * sin + constant(&along);
        let error = larger((found - exact).iter().map(|x| largest(*x)));
        // The omitted terms of the series are of order ten; beyond it quotients by the angle lose its powers in high derivatives.
        let allowed = if angle.abs() < 0.01 {
            1e-13 + angle * angle / 100.0
        } else {
            40320.0 * 1e-14 / angle.abs().min(1.0).powi(8)
        };
        assert!(error < allowed, "{angle}: {error:e}");
        let values = (found - exact).map(|x| x.re.re.re).amax();
        assert!(values < 2e-16, "{angle}: {values:e}");
    }
}

#[test]
fn a_principal_frame_is_one_to_the_third_order() {
    let variable = |value: f64, slope: f64, bend: f64| Dual3_64::new(value, slope, bend, 0.7 * slope - bend);
    let entries = [
        [variable(0.021, 0.3, -0.2), variable(0.004, -0.5, 0.9), variable(-0.007, 0.8, 0.4)],
        [variable(0.004, -0.5, 0.9), variable(-0.013, 0.6, 0.1), variable(0.002, 0.35, -1.1)],
        [variable(-0.007, 0.8, 0.4), variable(0.002, 0.35, -1.1), variable(0.011, -0.2, 0.7)],
    ];
    let tensor = Matrix3::from_fn(|i, j| entries[i][j]);
    let (values, rotation) = principal_frame_with_derivatives(&tensor).expect("distinct eigenvalues");
    let size = |m: &Matrix3<Dual3_64>| larger(m.iter().flat_map(|x| [x.re, x.v1, x.v2, x.v3]));
    // Third derivatives of the rotation are of the order of (slope / gap)^3.
    let scale = size(&rotation);
    assert!(scale > 1e5, "{scale:e}");
    let identity = Matrix3::from_fn(|i, j| Dual3_64::from(f64::from(u8::from(i == j))));
    assert!(size(&(rotation * rotation.transpose() - identity)) < 1e-12 * scale);
    let mut turned = rotation * tensor * rotation.transpose();
    for (i, value) in [values.xx, values.yy, values.zz].into_iter().enumerate() {
        turned[(i, i)] -= value;
    }
    assert!(size(&turned) < 1e-12 * scale * 0.02);
    let frame = principal_frame(&tensor.map(|x| x.re)).expect("distinct eigenvalues");
    assert_eq!(rotation.map(|x| x.re), frame.principal_from_given);
    // From the slope of the eigenvalues, which is that of the tensor along the axes.
    let axes = frame.principal_from_given;
    let slopes = axes * tensor.map(|x| x.v1) * axes.transpose();
    for (i, value) in [values.xx, values.yy, values.zz].into_iter().enumerate() {
        assert!((value.v1 - slopes[(i, i)]).abs() < 1e-14, "{i}");
    }
}

/// Equality of two eigenvalues is relative to the largest one.
#[test]
fn equal_eigenvalues_have_no_derivatives() {
    let diagonal = |values: [f64; 3]| Matrix3::from_diagonal(&Vector3::from(values)).map(|x| Dual64::new(x, 0.1));
    for unit in [1.0, 1e-9, 1e7] {
        let found = |values: [f64; 3]| principal_frame_with_derivatives(&diagonal(values.map(|x| x * unit))).is_ok();
        for (three, is_distinct) in [
            ([0.02, 0.02 * (1.0 - 3e-12), -0.01], true),
            ([0.02, 0.02 * (1.0 - 0.3e-12), -0.01], false),
            ([0.01, -0.02 * (1.0 - 3e-12), -0.02], true),
            ([0.01, -0.02 * (1.0 - 0.3e-12), -0.02], false),
            ([0.02, 1e-5, 1e-5 + 3e-14], true),
            ([0.02, 1e-5, 1e-5 + 0.6e-14], false),
        ] {
            assert_eq!(found(three), is_distinct, "{three:?} in units of {unit}");
        }
    }
}

/// Two equal eigenvalues that separate along a path are in descending order afterwards; three have no such order.
#[test]
fn equal_eigenvalues_part_in_descending_order() {
    let turn = body_from_inertial(&EulerAngles { alpha: 0.4, beta: 1.2, gamma: -0.7 });
    let slope = Matrix3::new(0.3, -0.2, 0.5, -0.2, 0.1, 0.4, 0.5, 0.4, -0.4);
    let parting = |values: [f64; 3]| {
        let tensor = turn.transpose() * PrincipalCoefficients::new(values).tensor() * turn;
        principal_frame_along(&((tensor + tensor.transpose()) * 0.5).zip_map(&slope, Dual64::new))
    };
    let (upper, _) = parting([0.02, 0.02, -0.03]).expect("a frame");
    assert!(upper.xx.re == upper.yy.re && upper.xx.eps > upper.yy.eps + 1.0, "{upper:?}");
    let (lower, _) = parting([0.02, -0.01, -0.01]).expect("a frame");
    assert!(lower.yy.re == lower.zz.re && lower.yy.eps > lower.zz.eps + 0.1, "{lower:?}");
    assert!(parting([0.02; 3]).is_err());
}
