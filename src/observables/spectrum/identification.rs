//! Names a spectral line as an integer combination of given frequencies, where there is one.

use core::fmt;

use crate::error::Error;

/// Largest `sum |k|` of a combination that is looked for.
const HIGHEST_ORDER: i32 = 12;

/// A combination so likely to fit by accident is not taken for one.
const LARGEST_CHANCE: f64 = 1e-3;

/// A fit is within this many times the estimated errors.
const TOLERANCE: f64 = 3.0;

/// A second fit whose order is at most this much higher than the first one's makes both doubtful.
const DOUBT: i32 = 2;

/// A frequency of which lines are combinations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generator {
    /// What it is called in print.
    pub symbol: &'static str,
    /// The frequency, of either sign (rad per unit of time).
    pub frequency: f64,
    /// Its estimated error.
    pub uncertainty: f64,
}

/// An integer combination of the generators that fits a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// The integers with the symbols of their generators, in the order of the basis.
    pub terms: Vec<(i32, &'static str)>,
    /// Its frequency.
    pub frequency: f64,
    /// Frequency of the line minus that of the combination.
    pub misfit: f64,
    /// Expected number of combinations of this order or lower that would fit a random frequency as near.
    pub chance: f64,
}

impl Combination {
    /// `sum |k|`.
    pub(crate) fn order(&self) -> i32 {
        self.terms.iter().map(|(k, _)| k.abs()).sum()
    }

    /// The integers alone.
    pub fn integers(&self) -> Vec<i32> {
        self.terms.iter().map(|(k, _)| *k).collect()
    }
}

impl fmt::Display for Combination {
    /// Prints `2 alpha' - l'`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut first = true;
        for &(k, symbol) in self.terms.iter().filter(|(k, _)| *k != 0) {
            match (first, k < 0) {
                (true, true) => write!(f, "-")?,
                (true, false) => {}
                (false, true) => write!(f, " - ")?,
                (false, false) => write!(f, " + ")?,
            }
            if k.abs() > 1 {
                write!(f, "{} ", k.abs())?;
            }
            write!(f, "{symbol}")?;
            first = false;
        }
        if first { write!(f, "0") } else { Ok(()) }
    }
}

/// What a line is.
#[derive(Debug, Clone, PartialEq)]
pub enum Identification {
    /// One combination fits, and not by accident.
    Identified(Combination),
    /// Several combinations of nearly the same order fit.
    Ambiguous(Vec<Combination>),
    /// No combination fits, or only such as could do so by accident.
    Unidentified,
}

impl Identification {
    /// The combination, if there is one and only one.
    pub fn combination(&self) -> Option<&Combination> {
        match self {
            Identification::Identified(combination) => Some(combination),
            Identification::Ambiguous(_) | Identification::Unidentified => None,
        }
    }
}

impl fmt::Display for Identification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Identification::Identified(combination) => write!(f, "{combination}"),
            Identification::Ambiguous(several) => write!(f, "ambiguous ({} combinations)", several.len()),
            Identification::Unidentified => write!(f, "unidentified"),
        }
    }
}

/// Up to three generators with all their combinations of order 12 or less.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyBasis {
    generators: Vec<Generator>,
    /// Integers and frequency of each combination, lowest orders first.
    combinations: Vec<([i32; 3], f64)>,
}

impl FrequencyBasis {
    /// The basis of one to three frequencies, none of them zero within its error.
    ///
    /// # Errors
    /// [`Error::Domain`] for another number of generators, for one that is zero or not finite, and for an uncertainty that is
    /// negative or not finite.
    pub fn new(generators: Vec<Generator>) -> Result<Self, Error> {
        let count = generators.len();
        Error::ensure((1..=3).contains(&count), "number of generators", count as f64, "one to three")?;
        for g in &generators {
            let error = g.uncertainty;
            Error::ensure(error >= 0.0 && error.is_finite(), "error of a generator", error, "zero or above, finite")?;
            let apart = g.frequency.abs() > error && g.frequency.is_finite();
            Error::ensure(apart, "frequency of a generator", g.frequency, "farther from zero than its error, finite")?;
        }
        let range = |i: usize| if i < count { HIGHEST_ORDER } else { 0 };
        let mut combinations = Vec::new();
        for a in -range(0)..=range(0) {
            for b in -range(1)..=range(1) {
                for c in -range(2)..=range(2) {
                    let integers = [a, b, c];
                    if order(&integers) <= HIGHEST_ORDER {
                        let terms = generators.iter().zip(integers).map(|(g, k)| g.frequency * f64::from(k));
                        combinations.push((integers, terms.sum()));
                    }
                }
            }
        }
        combinations.sort_by_key(|(integers, _)| order(integers));
        Ok(Self { generators, combinations })
    }

    /// The generators.
    pub fn generators(&self) -> &[Generator] {
        &self.generators
    }

    /// The combination `sum k_i f_i` of lowest `sum |k_i|` within the errors of a line at `frequency` (of either sign) and of
    /// the generators; threefold errors are allowed for.
    ///
    /// Not taken: orders above 12; a combination whose chance of fitting a random frequency as near is above 1e-3 (its
    /// tolerance times the density of combinations of its order or lower around the line); one of several whose orders differ
    /// by two or less.
    pub fn identify(&self, frequency: f64, uncertainty: f64) -> Identification {
        let mut fitting: Vec<Combination> = Vec::new();
        for (integers, value) in &self.combinations {
            if fitting.first().is_some_and(|first| order(integers) > first.order() + DOUBT) {
                break;
            }
            let errors = self.generators.iter().zip(integers).map(|(g, k)| g.uncertainty * f64::from(k.abs()));
            let rounding = f64::EPSILON * (frequency.abs() + value.abs());
            let tolerance = TOLERANCE * (uncertainty + errors.sum::<f64>() + rounding);
            if (value - frequency).abs() <= tolerance {
                fitting.push(Combination {
                    terms: self.generators.iter().zip(integers).map(|(g, &k)| (k, g.symbol)).collect(),
                    frequency: *value,
                    misfit: frequency - value,
                    chance: 2.0 * tolerance * self.density(frequency, order(integers)),
                });
            }
        }
        fitting.retain(|combination| combination.chance <= LARGEST_CHANCE);
        match fitting.len() {
            0 => Identification::Unidentified,
            1 => Identification::Identified(fitting.remove(0)),
            _ => Identification::Ambiguous(fitting),
        }
    }

    /// Combinations up to an order per unit of frequency, in an interval around `frequency` as wide as the largest generator.
    fn density(&self, frequency: f64, most: i32) -> f64 {
        let width = self.generators.iter().fold(0.0_f64, |most, g| most.max(g.frequency.abs()));
        let near = self.combinations.iter().take_while(|(integers, _)| order(integers) <= most);
        near.filter(|(_, value)| (value - frequency).abs() <= width / 2.0).count() as f64 / width
    }
}

fn order(integers: &[i32; 3]) -> i32 {
    integers.iter().map(|k| k.abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A generator alone: what fits is as near as three times all errors, and its chance is that of its tolerance.
    #[test]
    fn tolerances_and_chances_are_those_of_the_errors() {
        for (generator, error) in [(2.0, 1e-7), (-2.0, 1e-7), (2.0, 0.0)] {
            let symbol = "a";
            let basis =
                FrequencyBasis::new(vec![Generator { symbol, frequency: generator, uncertainty: error }]).unwrap();
            for (k, uncertainty) in [(3_i32, 2e-7), (-12, 2e-7), (1, 0.0), (12, 1e-12)] {
                let value = generator * f64::from(k);
                let rounding = 2.0 * f64::EPSILON * value.abs();
                let allowed = 3.0 * (uncertainty + error * f64::from(k.abs()) + rounding);
                for side in [1.0, -1.0] {
                    let near = value + side * (0.999 * allowed - 0.5 * rounding);
                    let found = basis.identify(near, uncertainty);
                    let combination = found.combination().unwrap_or_else(|| panic!("{generator} {k}"));
                    assert_eq!((combination.integers(), combination.order()), (vec![k], k.abs()));
                    assert_eq!((combination.frequency, combination.misfit), (value, near - value));
                    // One combination in an interval of the length two.
                    let tolerance =
                        3.0 * (uncertainty + error * f64::from(k.abs()) + f64::EPSILON * (near.abs() + value.abs()));
                    assert!((combination.chance / tolerance - 1.0).abs() < 1e-12);
                    let far = value + side * (1.001 * allowed + 0.5 * rounding);
                    assert_eq!(basis.identify(far, uncertainty), Identification::Unidentified);
                }
            }
            assert_eq!(basis.identify(13.0 * generator, 1e-9), Identification::Unidentified);
            // Too great a chance: twice the tolerance times a half above a thousandth.
            let chance = |uncertainty: f64| basis.identify(generator, uncertainty).combination().is_some();
            assert!(chance(1e-3 / 3.0 - 2e-7) && !chance(1e-3 / 3.0 + 2e-7));
        }
    }

    /// Combinations of all orders up to that of the line count, within half of the largest generator.
    #[test]
    fn the_density_is_of_combinations_of_its_order() {
        let generator = |symbol, frequency| Generator { symbol, frequency, uncertainty: 0.0 };
        // In any unit of frequency.
        for unit in [1.0, 0.2] {
            let generators = vec![generator("a", 0.37 * unit), generator("b", -1.1 * unit)];
            let basis = FrequencyBasis::new(generators).unwrap();
            for (frequency, most) in [(0.2, 3), (-2.3, 5), (1.47, 12)] {
                let count = (-12..=12_i32)
                    .flat_map(|a| (-12..=12_i32).map(move |b| (a, b)))
                    .filter(|(a, b)| a.abs() + b.abs() <= most)
                    .filter(|(a, b)| (0.37 * f64::from(*a) - 1.1 * f64::from(*b) - frequency).abs() <= 0.55)
                    .count();
                let density = basis.density(frequency * unit, most);
                assert!((density * 1.1 * unit - count as f64).abs() < 1e-9, "{density} {count}");
            }
        }
    }

    fn basis() -> FrequencyBasis {
        let generator = |symbol, frequency| Generator { symbol, frequency, uncertainty: 1e-12 };
        FrequencyBasis::new(vec![generator("a'", 1.394_678_311_03), generator("g'", -0.144_217_531_17)]).unwrap()
    }

    #[test]
    fn combinations_print_as_sums() {
        let print = |frequency: f64| basis().identify(frequency, 1e-10).to_string();
        let (a, g) = (1.394_678_311_03, -0.144_217_531_17);
        assert_eq!(print(2.0 * a - g), "2 a' - g'");
        assert_eq!(print(-g), "-g'");
        assert_eq!(print(a + 3.0 * g), "a' + 3 g'");
        assert_eq!(print(0.0), "0");
        assert_eq!(print(1.0), "unidentified");
    }

    #[test]
    fn near_resonance_is_ambiguous() {
        let generator = |symbol, frequency| Generator { symbol, frequency, uncertainty: 1e-10 };
        let resonant = FrequencyBasis::new(vec![generator("a'", 1.0), generator("b'", 0.5)]).unwrap();
        assert_eq!(resonant.identify(1.0, 1e-10).to_string(), "ambiguous (2 combinations)");
    }

    #[test]
    fn what_is_no_basis_is_refused() {
        let one = Generator { symbol: "a'", frequency: 1.0, uncertainty: 1e-10 };
        assert!(FrequencyBasis::new(vec![]).is_err() && FrequencyBasis::new(vec![one; 4]).is_err());
        for wrong in [
            Generator { frequency: 1e-11, ..one },
            Generator { frequency: f64::NAN, ..one },
            Generator { uncertainty: -1.0, ..one },
            Generator { uncertainty: f64::INFINITY, ..one },
        ] {
            assert!(FrequencyBasis::new(vec![wrong]).is_err());
        }
    }

    /// The sum of the sizes of both integers counts.
    #[test]
    fn orders_above_twelve_are_not_taken() {
        let generator = |symbol, frequency| Generator { symbol, frequency, uncertainty: 0.0 };
        let basis = FrequencyBasis::new(vec![generator("a", 0.371), generator("b", -1.137)]).unwrap();
        for (a, b, is_taken) in [(7, 5, true), (-7, 5, true), (7, 6, false), (-7, 6, false), (-12, -12, false)] {
            let found = basis.identify(0.371 * f64::from(a) - 1.137 * f64::from(b), 1e-12);
            assert_eq!(found.combination().map(Combination::integers), is_taken.then(|| vec![a, b]));
        }
    }
}
