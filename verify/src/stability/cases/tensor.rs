//! Principal axes of the tensor, the nearest axisymmetric tensor.

use twofold::lorentz_violation::{SymmetryOfTensor, principal_frame_along, principal_frame_with_derivatives};

use super::parts::*;

/// Eigenvalues in descending order by Jacobi's rotations.
fn eigenvalues<S: Real>(tensor: &Matrix3<S>) -> [S; 3] {
    let mut a = *tensor;
    let size = a.iter().map(|x| x.re().abs()).fold(0.0, f64::max);
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[(p, q)].re().abs() <= 1e-45 * size {
                continue;
            }
            let theta = (a[(q, q)] - a[(p, p)]) / (a[(p, q)] * 2.0);
            let sign = if theta.re() < 0.0 { -1.0 } else { 1.0 };
            let t = S::from_f64(sign) / (theta.abs() + (theta * theta + S::one()).sqrt());
            let c = S::one() / (t * t + S::one()).sqrt();
            let mut rotation = Matrix3::identity();
            (rotation[(p, p)], rotation[(q, q)]) = (c, c);
            (rotation[(p, q)], rotation[(q, p)]) = (t * c, -(t * c));
            a = rotation.transpose() * a * rotation;
        }
    }
    let mut values = [a[(0, 0)], a[(1, 1)], a[(2, 2)]];
    values.sort_by(|x, y| y.re().total_cmp(&x.re()));
    values
}

fn values<S: Real>(s: &PrincipalCoefficients<S>) -> Vec<S> {
    vec![s.xx, s.yy, s.zz]
}

functions! {
    ExactValues(x) { eigenvalues(&symmetric(x)).to_vec() }
    /// The eigenvalues, and zeros for the off-diagonal elements after the rotation.
    ExactFrame(x) {
        let mut all = eigenvalues(&symmetric(x)).to_vec();
        all.extend([S::zero(); 3]);
        all
    }
    WithDerivatives: "principal_frame_with_derivatives".against::<ExactValues>().composite().vector(), (x) {
        principal_frame_with_derivatives(&symmetric(x)).map_or(none(3), |(s, _)| values(&s))
    }
    ExactSymmetry(x) {
        let [first, second, third] = eigenvalues(&symmetric(x));
        let half = S::from_f64(2.0);
        vec![if (first - second).re() <= (second - third).re() {
            third - (first + second) / half
        } else {
            first - (second + third) / half
        }]
    }
    OfCoefficients: "PrincipalCoefficients", (x) {
        let s = PrincipalCoefficients::new([x[0], x[1], x[2]]);
        vec![s.combination(), s.asymmetry(), s.scaled(x[3]).xx, s.permuted().zz, s.tensor()[(1, 1)]]
    }
}

/// The tensor is rotated in double-double numbers, so that only the error of the rotation matrix shows.
fn frame(x: &[f64]) -> Vec<f64> {
    let tensor = symmetric(x);
    principal_frame(&tensor).map_or(none(6), |found| {
        let q: Matrix3<Wide> = found.principal_from_given.map(<Wide as twofold::Scalar>::from_f64);
        let turned = q * tensor.map(<Wide as twofold::Scalar>::from_f64) * q.transpose();
        let mut all = values(&found.coefficients);
        all.extend([turned[(0, 1)], turned[(0, 2)], turned[(1, 2)]].map(|entry| entry.high()));
        all
    })
}

fn symmetry(x: &[f64]) -> Vec<f64> {
    SymmetryOfTensor::of(&symmetric(x)).map_or(none(1), |found| vec![found.difference])
}

fn along(x: &[f64]) -> Vec<f64> {
    along_with_derivatives(&x.iter().map(|&x| Dual64::from_re(x)).collect::<Vec<_>>())
        .iter()
        .map(|value| value.re)
        .collect()
}

fn along_with_derivatives(x: &[Dual64]) -> Vec<Dual64> {
    principal_frame_along(&symmetric(x)).map_or(none(3), |(s, _)| values(&s))
}

const ANY: &str = "entries from 1e-290 to 1";

pub(super) fn cases() -> Vec<Case> {
    let (c, tiny) = (In(-1.0, 1.0), Signed(-15.0, -2.0));
    let any = [Signed(-290.0, 0.0); 6];
    let isotropic = [Near(0.1, -15.0, -2.0), Fixed(0.1), Fixed(0.1), tiny, tiny, tiny];
    let pair = [Near(0.1, -15.0, -2.0), Fixed(0.1), In(-0.5, 0.0), tiny, Signed(-3.0, -1.0), Signed(-3.0, -1.0)];
    let general = [c; 6];
    let mut cases = Vec::new();
    for (limit, inputs) in [
        (ANY, any),
        ("all eigenvalues nearly equal", isotropic),
        ("two eigenvalues nearly equal", pair),
        ("any tensor", general),
    ] {
        cases.push(Case::of_doubles::<ExactFrame>("principal_frame", limit, &inputs, frame).composite().vector());
        // Two gaps can be equal within rounding: the nearest pair is then undetermined.
        if limit != ANY {
            cases.push(Case::of_doubles::<ExactSymmetry>("SymmetryOfTensor::of", limit, &inputs, symmetry).except(
                64.0,
                "A difference of eigenvalues, each found by iteration to a few ulp of the largest one: \
condition number s / difference.",
            ));
        }
    }
    cases.extend([
        WithDerivatives::case("any tensor", &general),
        WithDerivatives::case("nearly diagonal", &list![c; 3, tiny; 3]),
        Case::of_doubles::<ExactValues>("principal_frame_along", "any tensor", &general, along)
            .with_derivatives(along_with_derivatives)
            .composite()
            .vector(),
        OfCoefficients::case(
            "equal and nearly equal eigenvalues",
            &[Near(0.1, -15.0, -2.0), Fixed(0.1), Near(0.1, -15.0, -2.0), Signed(-100.0, 100.0)],
        ),
    ]);
    cases
}
