//! The journal of a growing table: which of its bytes are known to be on the disk. A line is a checksum and a JSON value; a
//! torn line and everything after it are ignored.

use std::io::Read;
use std::ops::Range;

use serde_json::{Value, json};

/// The state of the table up to some scene.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Mark {
    /// First scene that is not in the table.
    pub(super) next: u64,
    /// Number of rows whose scene failed.
    pub(super) failed: u64,
    pub(super) rows: Prefix,
    pub(super) errors: Prefix,
}

/// The beginning of a file up to some byte.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Prefix {
    pub(super) length: u64,
    /// CRC-32 of the bytes since the previous mark.
    pub(super) checksum: u32,
}

/// The readable part of a journal.
#[derive(Debug, Default)]
pub(super) struct Journal {
    /// The input of the table.
    pub(super) identity: Option<Value>,
    /// Marks in order, each with the length of the journal up to it.
    pub(super) marks: Vec<(Mark, u64)>,
    /// Whether the table was complete and about to be renamed.
    pub(super) complete: bool,
}

pub(super) fn line(value: &Value) -> Vec<u8> {
    let text = value.to_string();
    format!("{:08x} {text}\n", crc32fast::hash(text.as_bytes())).into_bytes()
}

fn value(line: &[u8]) -> Option<Value> {
    let (checksum, text) = std::str::from_utf8(line).ok()?.split_once(' ')?;
    let intact = checksum == format!("{:08x}", crc32fast::hash(text.as_bytes()));
    if intact { serde_json::from_str(text).ok() } else { None }
}

pub(super) fn completion() -> Value {
    json!({ "complete": true })
}

impl Mark {
    pub(super) fn to_value(self) -> Value {
        json!({
            "next": self.next,
            "failed": self.failed,
            "rows": [self.rows.length, self.rows.checksum],
            "errors": [self.errors.length, self.errors.checksum],
        })
    }

    /// Whether this mark is possible for a table of `scenes`.
    pub(super) fn is_of(&self, scenes: &Range<u64>) -> bool {
        scenes.start <= self.next && self.next <= scenes.end && self.failed <= self.next - scenes.start
    }

    fn from_value(value: &Value) -> Option<Self> {
        let prefix = |value: &Value| {
            let checksum = u32::try_from(value[1].as_u64()?).ok()?;
            Some(Prefix { length: value[0].as_u64()?, checksum })
        };
        Some(Self {
            next: value["next"].as_u64()?,
            failed: value["failed"].as_u64()?,
            rows: prefix(&value["rows"])?,
            errors: prefix(&value["errors"])?,
        })
    }
}

/// The journal `bytes` with the digits of a number in a line replaced and the checksum of the line recomputed, for fuzzing.
pub fn signed_again(bytes: &[u8], line: usize, number: usize, digits: &[u8]) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> = bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    let Some(place) = lines.get_mut(line).filter(|line| line.len() > 9) else { return bytes.to_vec() };
    let mut text = place[9..].to_vec();
    let is_digit = |at: usize| text[at].is_ascii_digit();
    let starts = (0..text.len()).filter(|&at| is_digit(at) && !text[..at].last().is_some_and(u8::is_ascii_digit));
    let Some(start) = starts.into_iter().nth(number) else { return bytes.to_vec() };
    let end = (start..text.len()).find(|&at| !is_digit(at)).unwrap_or(text.len());
    text.splice(start..end, digits.iter().copied());
    let Ok(value) = serde_json::from_slice(&text) else { return bytes.to_vec() };
    *place = self::line(&value);
    lines.concat()
}

impl Journal {
    pub(super) fn read(mut file: impl Read) -> std::io::Result<Self> {
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let mut journal = Self::default();
        let mut length = 0;
        // Bytes after the last line end are torn.
        for line in bytes.split_inclusive(|byte| *byte == b'\n').filter(|line| line.ends_with(b"\n")) {
            let Some(value) = value(&line[..line.len() - 1]) else { break };
            length += line.len() as u64;
            if journal.identity.is_none() {
                journal.identity = Some(value);
            } else if value == completion() {
                journal.complete = true;
            } else {
                let Some(mark) = Mark::from_value(&value) else { break };
                journal.marks.push((mark, length));
            }
        }
        Ok(journal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_journal_torn_or_damaged_anywhere_is_read_up_to_there() {
        let mark = |next| Mark { next, failed: 1, ..Mark::default() };
        let lines = [line(&json!({ "sweep": "text" })), line(&mark(4).to_value()), line(&mark(9).to_value())];
        let whole = lines.concat();
        let ends: Vec<_> = lines
            .iter()
            .scan(0, |end, line| {
                *end += line.len();
                Some(*end)
            })
            .collect();
        for cut in 0..=whole.len() {
            let complete = ends.iter().filter(|end| **end <= cut).count();
            let journal = Journal::read(&whole[..cut]).expect("memory can be read");
            assert_eq!(journal.identity.is_some(), complete > 0, "{cut}");
            assert_eq!(journal.marks.len(), complete.saturating_sub(1), "{cut}");
            if let Some((last, length)) = journal.marks.last() {
                assert_eq!((last.next, *length), ([4, 9][journal.marks.len() - 1], ends[complete - 1] as u64));
            }
        }
        for damaged in 0..whole.len() {
            let mut bytes = whole.clone();
            bytes[damaged] ^= 0x15;
            let journal = Journal::read(bytes.as_slice()).expect("memory can be read");
            let before = ends.iter().filter(|end| **end <= damaged).count();
            assert_eq!(usize::from(journal.identity.is_some()) + journal.marks.len(), before, "{damaged}");
        }
    }

    /// A mark lies within the scenes, and the failed scenes are not more than those done.
    #[test]
    fn a_mark_is_of_the_scenes_it_counts() {
        let is_of = |next, failed| Mark { next, failed, ..Mark::default() }.is_of(&(3..9));
        assert_eq!([2, 3, 9, 10].map(|next| is_of(next, 0)), [false, true, true, false]);
        assert_eq!([(5, 2), (5, 3), (3, 1)].map(|(next, failed)| is_of(next, failed)), [true, false, false]);
    }

    /// The numbers of a line are counted from zero, after its checksum. Lines or numbers that do not exist, and replacements that
    /// are not JSON, change nothing.
    #[test]
    fn a_number_is_replaced_under_a_new_signature() {
        let (first, second) = (line(&json!({ "a": 12, "b": [3] })), line(&json!(45)));
        let journal = [first.clone(), second.clone(), b"\n".to_vec()].concat();
        let forged = |line, number, digits: &[u8]| signed_again(&journal, line, number, digits);
        assert_eq!(forged(0, 0, b"7"), [line(&json!({ "a": 7, "b": [3] })), second.clone(), b"\n".to_vec()].concat());
        assert_eq!(forged(0, 1, b"77"), [line(&json!({ "a": 12, "b": [77] })), second, b"\n".to_vec()].concat());
        assert_eq!(forged(1, 0, b"6"), [first, line(&json!(6)), b"\n".to_vec()].concat());
        for (line, number, digits) in [(0, 2, b"7"), (1, 1, b"7"), (2, 0, b"7"), (3, 0, b"7"), (0, 0, b"]")] {
            assert_eq!(forged(line, number, digits), journal, "{line} {number}");
        }
        assert_eq!(signed_again(b"01234567 5", 0, 0, b"7"), line(&json!(7)));
        // A complete line: its nine bytes are a checksum and nothing else.
        assert_eq!(signed_again(b"01234567 ", 0, 0, b"7"), b"01234567 ");
    }

    #[test]
    fn a_journal_ends_with_its_completion() {
        let whole = [line(&json!({ "sweep": "text" })), line(&completion())].concat();
        assert!(Journal::read(whole.as_slice()).expect("memory can be read").complete);
        assert!(!Journal::read(&whole[..whole.len() - 1]).expect("memory can be read").complete);
    }
}
