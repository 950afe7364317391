//! Integer combinations of fundamental frequencies.

use core::fmt;

/// An integer combination `sum k_i f_i` of fundamental frequencies.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Combination {
    /// The integers with the symbols of their frequencies.
    pub terms: Vec<(i32, &'static str)>,
}

impl Combination {
    /// The integer coefficient of a frequency.
    pub fn multiple(&self, symbol: &str) -> i32 {
        self.terms.iter().find(|(_, found)| *found == symbol).map_or(0, |(k, _)| *k)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_print_as_sums() {
        let print = |a: i32, g: i32| Combination { terms: vec![(a, "a'"), (g, "g'")] }.to_string();
        assert_eq!(print(2, -1), "2 a' - g'");
        assert_eq!(print(0, -1), "-g'");
        assert_eq!(print(1, 3), "a' + 3 g'");
        assert_eq!(print(-2, 0), "-2 a'");
        assert_eq!(print(0, 0), "0");
    }

    #[test]
    fn a_frequency_that_is_not_in_a_combination_is_there_no_times() {
        let combination = Combination { terms: vec![(2, "a'"), (-1, "g'")] };
        assert_eq!(["a'", "g'", "l'"].map(|symbol| combination.multiple(symbol)), [2, -1, 0]);
    }
}
