//! The fundamental frequencies found, and which of them are independent.

use nalgebra::Matrix3;

use super::MeanRate;
use crate::error::Error;
use crate::observables::spectrum::{FrequencyBasis, Generator};

/// Mean rates of the angles of a motion about one axis (rad per unit of time).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FundamentalFrequencies {
    /// Rotation from the frame of the motion to the one to which the angles belong: the third row is the axis.
    pub frame: Matrix3<f64>,
    /// Of the precession angle `alpha`. None where `n` comes as near as one likes to a pole of the axis, on either side of it: `alpha`
    /// and `gamma` then jump by half a turn in no regular sequence, and their mean rates are no fundamental frequencies.
    pub alpha: Option<MeanRate>,
    /// Of the rotation angle `gamma`. None with `alpha`.
    pub gamma: Option<MeanRate>,
    /// Of the azimuth of `L`. None where `L` passes the axis so near that its turns cannot be counted.
    pub momentum: Option<MeanRate>,
    /// Of the azimuth of `L` averaged over the fast rotation: the slow precession. Zero about an axis that it does not go round.
    /// None where it stays on the axis: there is no such circle.
    pub slow: Option<MeanRate>,
    /// Of the fast part of `n` round the averaged `L`, from the plane of `L` and the axis (from a fixed plane where `slow` is
    /// none). None where `n` has no fast part, as in steady precession.
    pub nutation: Option<MeanRate>,
    /// Of `e_x` about `n`, from the direction in which the fast part of `n` moves: `gamma'` but for whole turns of the nutation, and
    /// regular at the poles. None with `nutation`.
    pub body: Option<MeanRate>,
}

impl FundamentalFrequencies {
    /// The independent frequencies, for [`FrequencyBasis::identify`]: `alpha'`, `gamma'`, and of `l'` (`slow`) and `nu'` (`nutation`)
    /// the one that is no combination of those before it; `l'`, `nu'` and `psi'` (`body`) where `alpha` has no mean rate. Frequencies that are
    /// zero within their errors are left out.
    ///
    /// # Errors
    /// [`Error::Domain`] if all are zero.
    pub fn basis(&self) -> Result<FrequencyBasis, Error> {
        let differ = |a: &MeanRate, b: &MeanRate| {
            (a.value - b.value).abs() > 10.0 * (a.uncertainty + b.uncertainty) + 1e-12 * (a.value.abs() + b.value.abs())
        };
        let zero = MeanRate { value: 0.0, uncertainty: 0.0 };
        let moving = |rate: Option<MeanRate>| rate.filter(|rate| differ(rate, &zero));
        let (alpha, slow, nutation) = (moving(self.alpha), moving(self.slow), moving(self.nutation));
        let alpha_is_fast = alpha.is_some_and(|alpha| slow.is_none_or(|slow| differ(&slow, &alpha)));
        let chosen = if self.alpha.is_some() && self.gamma.is_some() {
            let (slow, nutation) = if alpha_is_fast { (slow, None) } else { (None, nutation) };
            vec![("alpha'", alpha), ("gamma'", moving(self.gamma)), ("l'", slow), ("nu'", nutation)]
        } else {
            vec![("l'", slow), ("nu'", nutation), ("psi'", moving(self.body))]
        };
        let generators = chosen.into_iter().filter_map(|(symbol, rate)| {
            rate.map(|rate| Generator { symbol, frequency: rate.value, uncertainty: rate.uncertainty })
        });
        FrequencyBasis::new(generators.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_rates(rates: [Option<MeanRate>; 5]) -> FundamentalFrequencies {
        let [alpha, gamma, slow, nutation, body] = rates;
        FundamentalFrequencies { frame: Matrix3::identity(), alpha, gamma, momentum: None, slow, nutation, body }
    }

    const fn rate(value: f64, uncertainty: f64) -> MeanRate {
        MeanRate { value, uncertainty }
    }

    #[test]
    fn the_basis_is_of_what_moves_and_differs() {
        let symbols = |rates: [Option<MeanRate>; 5]| {
            let basis = with_rates(rates).basis().map_err(|_| ())?;
            Ok::<_, ()>(basis.generators().iter().map(|g| (g.symbol, g.frequency, g.uncertainty)).collect::<Vec<_>>())
        };
        let [alpha, gamma, slow] = [rate(1.3, 1e-9), rate(-0.2, 2e-9), rate(-0.04, 3e-9)];
        let [nutation, body] = [rate(1.34, 4e-9), rate(0.7, 5e-9)];
        let of = |symbol: &'static str, rate: MeanRate| (symbol, rate.value, rate.uncertainty);
        let all = [Some(alpha), Some(gamma), Some(slow), Some(nutation), Some(body)];
        assert_eq!(symbols(all), Ok(vec![of("alpha'", alpha), of("gamma'", gamma), of("l'", slow)]));
        // alpha' is the slow precession itself, within ten times both errors, or 1e-12 of both.
        let near = |off: f64, size: f64, error: f64| {
            let slow = rate(size, error);
            let alpha = rate(size + off, 2.0 * error);
            symbols([Some(alpha), Some(gamma), Some(slow), Some(nutation), Some(body)]).unwrap()[2].0
        };
        for sign in [1.0, -1.0] {
            for off in [29.9e-9, -29.9e-9] {
                assert_eq!(near(off, 0.04 * sign, 1e-9), "nu'");
                assert_eq!(near(off * 1.01, 0.04 * sign, 1e-9), "l'");
            }
            for off in [1.99e-8, -1.99e-8] {
                assert_eq!(near(off, 1e4 * sign, 0.0), "nu'");
                assert_eq!(near(off * 1.02, 1e4 * sign, 0.0), "l'");
            }
        }
        // Without alpha' or gamma', or where one does not move.
        let others = Ok(vec![of("l'", slow), of("nu'", nutation), of("psi'", body)]);
        assert_eq!(symbols([None, None, Some(slow), Some(nutation), Some(body)]), others);
        assert_eq!(symbols([Some(alpha), None, Some(slow), Some(nutation), Some(body)]), others);
        assert_eq!(symbols([None, Some(gamma), Some(slow), Some(nutation), Some(body)]), others);
        let still = Some(rate(0.9e-8, 1e-9));
        assert_eq!(
            symbols([still, Some(gamma), Some(slow), Some(nutation), None]),
            Ok(vec![of("gamma'", gamma), of("nu'", nutation)])
        );
        assert_eq!(symbols([Some(alpha), still, None, Some(nutation), None]), Ok(vec![of("alpha'", alpha)]));
        assert_eq!(symbols([still; 5]), Err(()));
        assert_eq!(symbols([None; 5]), Err(()));
    }
}
