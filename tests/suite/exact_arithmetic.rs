//! Algebraic laws of the number types behind the exact checks: prime field, duals, conditioned numbers.

use nalgebra::{Matrix3, Vector3};
use num_traits::{One, Zero};
use quickcheck::{Gen, QuickCheck, Testable};
use twofold::Scalar;
use twofold_verify::dual::Dual;
use twofold_verify::magnitudes::Conditioned;
use twofold_verify::prime_field::{Fp, PRIME};

/// The same thousand cases on every run.
fn holds(property: impl Testable) {
    QuickCheck::new().rng(Gen::from_size_and_seed(100, 61)).tests(1000).quickcheck(property);
}

type Triple = (u64, u64, u64);

fn elements((a, b, c): Triple) -> [Fp; 3] {
    [a, b, c].map(Fp::new)
}

fn duals((a, b, c): Triple, (x, y, z): Triple) -> [Dual<Fp>; 3] {
    [(a, x), (b, y), (c, z)].map(|(re, eps)| Dual::new(Fp::new(re), Fp::new(eps)))
}

fn commutative_ring<F: Scalar>([a, b, c]: [F; 3]) -> bool {
    let (zero, one) = (F::zero(), F::one());
    (a + b) + c == a + (b + c)
        && a + b == b + a
        && a + zero == a
        && a + -a == zero
        && a - b == a + -b
        && (a * b) * c == a * (b * c)
        && a * b == b * a
        && a * one == a
        && a * (b + c) == a * b + a * c
        && zero != one
}

fn circle<F: Scalar>(angle: F) -> bool {
    let (sin, cos) = angle.sin_cos();
    sin * sin + cos * cos == F::one()
}

#[test]
fn prime_field_is_a_field() {
    fn property(x: Triple) -> bool {
        let [a, b, c] = elements(x);
        let quotient = b.is_zero() || ((a / b) * b == a && b * b.inverse() == Fp::one());
        commutative_ring([a, b, c]) && quotient
    }
    holds(property as fn(Triple) -> bool);
}

#[test]
fn prime_field_is_the_integers_modulo_the_prime() {
    fn property(a: u64, b: u64, exponent: u8) -> bool {
        let (p, wide) = (u128::from(PRIME), |x: u64| u128::from(x));
        let power = (0..exponent).fold(1, |product, _| product * (wide(a) % p) % p);
        let same = |x: Fp, value: u128| wide(x.value()) == value % p;
        let (x, y) = (Fp::new(a), Fp::new(b));
        same(x + y, wide(a) + wide(b))
            && same(x * y, wide(a) % p * (wide(b) % p))
            && same(x - y, wide(a) + p * 8 - wide(b) % p)
            && same(x.pow(u64::from(exponent)), power)
    }
    holds(property as fn(u64, u64, u8) -> bool);
    assert_eq!(Fp::new(PRIME), Fp::zero());
    assert_eq!(-Fp::zero(), Fp::zero());
}

#[test]
fn dyadic_constants_are_exact() {
    fn property(a: i16, b: i16, shift: u8) -> bool {
        let scale = f64::from(1_u32 << (shift % 5));
        let (x, y) = (f64::from(a) / scale, f64::from(b) / scale);
        let (fx, fy) = (Fp::from_f64(x), Fp::from_f64(y));
        fx + fy == Fp::from_f64(x + y) && fx * fy == Fp::from_f64(x * y) && fx * scale == Fp::from_f64(f64::from(a))
    }
    holds(property as fn(i16, i16, u8) -> bool);
}

#[test]
#[should_panic(expected = "not a small dyadic rational")]
fn rounded_constants_are_refused() {
    Fp::from_f64(0.1);
}

#[test]
#[should_panic(expected = "division by zero")]
fn division_by_zero_is_refused() {
    let _ = Fp::one() / Fp::zero();
}

#[test]
fn every_code_is_an_angle() {
    fn property(t: u64) -> bool {
        let t = Fp::new(t);
        let (sin, cos) = t.sin_cos();
        // The half-angle formula gives the code back.
        circle(t) && t * (Fp::one() + cos) == sin
    }
    holds(property as fn(u64) -> bool);
}

#[test]
fn duals_are_a_ring_and_divide() {
    fn property(x: Triple, dx: Triple, y: Triple) -> bool {
        let [a, b, c] = duals(x, dx);
        let nested = [Dual::new(a, b), Dual::new(b, c), Dual::new(c, duals(y, x)[0])];
        let quotient = b.re.is_zero() || (a / b) * b == a;
        let nested_quotient = b.re.is_zero() || (nested[0] / nested[1]) * nested[1] == nested[0];
        commutative_ring([a, b, c]) && commutative_ring(nested) && quotient && nested_quotient
    }
    holds(property as fn(Triple, Triple, Triple) -> bool);
}

#[test]
fn duals_differentiate() {
    fn property(x: Triple, dx: Triple) -> bool {
        let [a, b, _] = duals(x, dx);
        let (sin, cos) = a.sin_cos();
        // Leibniz's rule and the chain rule, in terms of the field.
        (a * b).eps == a.re * b.eps + a.eps * b.re
            && (b.re.is_zero() || (a / b).eps * b.re * b.re == a.eps * b.re - a.re * b.eps)
            && sin.eps == cos.re * a.eps
            && cos.eps == -(sin.re * a.eps)
            && circle(a)
    }
    holds(property as fn(Triple, Triple) -> bool);
}

#[test]
fn nested_duals_have_mixed_derivatives() {
    fn property((x, y, _): Triple) -> bool {
        let (x, y, one, zero) = (Fp::new(x), Fp::new(y), Fp::one(), Fp::zero());
        let u = Dual::new(Dual::new(x, one), Dual::new(zero, zero));
        let v = Dual::new(Dual::new(y, zero), Dual::new(one, zero));
        // d^2 (u^2 v^3) / du dv = 6 u v^2, and the second derivative of the sine is minus the sine.
        let both = Dual::new(Dual::new(x, one), Dual::new(one, zero));
        let (sin, _) = both.sin_cos();
        (u * u * v * v * v).eps.eps == x * y * y * 6.0 && sin.eps.eps == -sin.re.re && circle(both)
    }
    holds(property as fn(Triple) -> bool);
}

#[test]
fn vectors_and_matrices_run_over_the_field() {
    fn property(a: Triple, b: Triple, c: Triple) -> bool {
        let [a, b, c] = [a, b, c].map(|x| Vector3::from(elements(x)));
        let m = Matrix3::from_columns(&[a, b, c]);
        let n = m.transpose() * m;
        let determinant = a.cross(&b).dot(&c);
        let cofactors = Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)]);
        (m * n) * m == m * (n * m)
            && (m * n).transpose() == n.transpose() * m.transpose()
            && determinant == a.dot(&b.cross(&c))
            && a.cross(&b) == -b.cross(&a)
            && a.cross(&b.cross(&c)) == b * a.dot(&c) - c * a.dot(&b)
            && cofactors.transpose() * m == Matrix3::from_diagonal_element(determinant)
            && (m * n).trace() == (n * m).trace()
    }
    holds(property as fn(Triple, Triple, Triple) -> bool);
}

#[test]
fn conditioned_numbers_have_the_value_and_bound_it() {
    fn property(a: i16, b: i16, c: i16) -> bool {
        let [x, y, z] = [a, b, c].map(|n| f64::from(n) / 1024.0 + 1e-3);
        let [u, v, w] = [x, y, z].map(Conditioned::new);
        let term = u * v - w / u + (v - v);
        let (sin, cos) = w.sin_cos();
        let values = (term.value == x * y - z / x) && (sin.value, cos.value) == z.sin_cos();
        let bounded = [term, sin, cos].iter().all(|n| n.value.abs() <= n.magnitude);
        // Terms that cancel remain in the magnitude.
        values && bounded && term.magnitude >= 2.0 * y.abs() && (v - v).value == 0.0
    }
    holds(property as fn(i16, i16, i16) -> bool);
}
