//! A seeded generator of random numbers.

/// The generator SplitMix64 (Steele, Lea and Flood 2014): one word of state, with the same numbers on every machine.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// The generator that starts at `seed`.
    pub fn with_seed(seed: u64) -> Self {
        Self(seed)
    }

    /// A uniformly distributed word.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform number in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.word() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::Random;

    /// The first words for two seeds, as in Java's `SplittableRandom` and in published implementations of it.
    #[test]
    fn words_are_those_of_the_published_generator() {
        for (seed, words) in [
            (0, [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f]),
            (1_234_567, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]),
        ] {
            let mut random = Random::with_seed(seed);
            assert_eq!(words.map(|_| random.word()), words);
        }
    }

    /// A word as a fraction of 2^64, truncated to 53 bits: at most 2^-53 of the interval below, plus a rounding.
    #[test]
    fn a_number_lies_where_its_word_does_among_all_words() {
        let (mut words, mut numbers) = (Random::with_seed(3), Random::with_seed(3));
        for _ in 0..20 {
            let (part, number) = (words.word() as f64 * 0.5_f64.powi(64), numbers.within(3.0, 7.0));
            assert!((number - (3.0 * (1.0 - part) + 7.0 * part)).abs() < 16.0 * f64::EPSILON, "{number}");
        }
    }
}
