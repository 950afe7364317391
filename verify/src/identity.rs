//! An identity between the kernels and their derivation, tested with and without rounding.

use crate::prelude::*;
use crate::random::Drawn;

/// Field points per exact check.
const FIELD_POINTS: usize = 24;

/// Physical points per check with automatic derivatives.
const PHYSICAL_POINTS: usize = 200;

/// Numbers that vanish at every point, written once for all types of numbers.
pub trait Identity: 'static {
    /// Id of the exact check.
    const ID: &'static str;
    /// The check in floating point: [`Kind::Autodiff`] if it contains derivatives, and its id.
    const ROUNDED: (Kind, &'static str);
    /// Equation numbers.
    const EQUATIONS: &'static [u8];
    /// The statement.
    const STATEMENT: &'static str;

    /// Left side minus right side of each component.
    fn residuals<F: Differentiable>(point: &Point<F>) -> Vec<F>;
}

/// The two checks of an identity.
pub fn checks<I: Identity>() -> [Check; 2] {
    [
        Check {
            id: I::ID,
            kind: Kind::Exact,
            equations: I::EQUATIONS,
            statement: I::STATEMENT,
            figure: "residuals that are not zero, at 24 random points of the field modulo 2^61 - 1",
            bound: Bound::AtMost(0.0),
            reason: "exact arithmetic; a false identity of degree d vanishes at a random point with probability d / 2^61",
            measure: || nonzero_residuals(I::residuals),
        },
        Check {
            id: I::ROUNDED.1,
            kind: I::ROUNDED.0,
            equations: I::EQUATIONS,
            statement: I::STATEMENT,
            figure: "largest residual / (2.2e-16 x sum of magnitudes of its terms), 200 random physical points",
            bound: Bound::AtMost(2.0),
            reason: "each term is rounded some tens of times by half an ulp at most, independently of the others; how much of a value cancellation costs, `twofold stability` \
                     measures",
            measure: || largest_rounding(I::residuals, I::residuals),
        },
    ]
}

fn points<F: Drawn>(seed: u64, count: usize) -> impl Iterator<Item = Point<F>> {
    let mut random = Random::with_seed(seed);
    (0..count).map(move |_| Point::draw(&mut random))
}

/// The residuals of an identity at a point.
type Residuals<F> = fn(&Point<F>) -> Vec<F>;

fn nonzero_residuals(residuals: Residuals<Fp>) -> Result<Measured, String> {
    let (mut nonzero, mut total, mut first) = (0, 0, String::new());
    for (index, point) in points::<Fp>(61, FIELD_POINTS).enumerate() {
        for (component, residual) in residuals(&point).into_iter().enumerate() {
            total += 1;
            if !residual.is_zero() {
                nonzero += 1;
                if first.is_empty() {
                    first = format!("; first at point {index}, component {component}: {residual:?}");
                }
            }
        }
    }
    if total == 0 {
        return Err("the identity has no components".into());
    }
    Ok(Measured::new(f64::from(nonzero), format!("{total} residuals, seed 61{first}")))
}

fn largest_rounding(residuals: Residuals<f64>, with_magnitudes: Residuals<Conditioned>) -> Result<Measured, String> {
    let seed = 2021;
    let mut worst = Worst::default();
    let pairs = points::<f64>(seed, PHYSICAL_POINTS).zip(points::<Conditioned>(seed, PHYSICAL_POINTS));
    for (index, (point, conditioned)) in pairs.enumerate() {
        let scales = with_magnitudes(&conditioned);
        for (component, (residual, scale)) in residuals(&point).into_iter().zip(scales).enumerate() {
            if !scale.magnitude.is_finite() {
                return Err(format!("component {component} at point {index} of seed {seed} has no finite magnitude"));
            }
            let figure = if residual == 0.0 { 0.0 } else { residual.abs() / (f64::EPSILON * scale.magnitude) };
            worst.see(figure, || format!("component {component} at point {index} of seed {seed}: {residual:e}"));
        }
    }
    worst.finish()
}
