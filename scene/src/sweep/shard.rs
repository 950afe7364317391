//! A part of a sweep: the scenes of one job out of several.

use std::ops::Range;
use std::str::FromStr;

/// Part `part` of `parts`, counted from one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    part: u64,
    parts: u64,
}

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Self = Self { part: 1, parts: 1 };

    /// The scenes of this part out of `count`: consecutive, so that the concatenated tables of the parts are the whole one.
    pub fn scenes(&self, count: u64) -> Range<u64> {
        let end = |part: u64| (u128::from(count) * u128::from(part) / u128::from(self.parts)) as u64;
        end(self.part - 1)..end(self.part)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let allowed = || "must be i/n with whole numbers 1 <= i <= n <= 1000000, such as 3/16".to_owned();
        let (part, parts) = text.split_once('/').ok_or_else(allowed)?;
        let (part, parts) = (part.parse().map_err(|_| allowed())?, parts.parse().map_err(|_| allowed())?);
        if 1 <= part && part <= parts && parts <= 1_000_000 { Ok(Self { part, parts }) } else { Err(allowed()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_disjoint_and_their_union_is_the_whole() {
        for count in [0, 1, 5, 1000, 999_999_999_999, u64::MAX] {
            for parts in [1, 2, 3, 7, 1000] {
                let mut next = 0;
                for part in 1..=parts {
                    let scenes = Shard { part, parts }.scenes(count);
                    assert_eq!(scenes.start, next);
                    assert!((scenes.end - scenes.start).abs_diff(count / parts) <= 1);
                    next = scenes.end;
                }
                assert_eq!(next, count);
            }
        }
    }

    #[test]
    fn a_shard_is_written_i_of_n() {
        assert_eq!("3/16".parse(), Ok(Shard { part: 3, parts: 16 }));
        assert_eq!("1000000/1000000".parse(), Ok(Shard { part: 1_000_000, parts: 1_000_000 }));
        for bad in ["", "3", "0/4", "5/4", "1/0", "-1/4", "1/2/3", "a/b", "1/1000001"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
