//! The pages `docs/worked-*.md`: their files are written verbatim, their commands run, and every printed word and number is compared.

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::{Folder, TWOFOLD, stderr};

/// Relative tolerance for numbers. The motion is computed to 1e-13 of a component, and its last digits differ between
/// processors; a printed number can be a difference of components, or a component near zero that has lost four digits.
const RELATIVE: f64 = 1e-9;

/// A part of a text.
#[derive(Debug, Clone, PartialEq)]
enum Token<'t> {
    Words(&'t str),
    /// A number as written.
    Number(&'t str),
}

/// Numbers and the text between them. A digit after a letter, as in `e_x2`, belongs to the word.
fn tokens(line: &str) -> Vec<Token<'_>> {
    let (bytes, mut tokens, mut at, mut words) = (line.as_bytes(), Vec::new(), 0, 0);
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    while at < bytes.len() {
        let follows_word =
            at > 0 && (bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'_' || bytes[at - 1] == b'.');
        let sign = usize::from(bytes[at] == b'-' || bytes[at] == b'+');
        if follows_word || !bytes.get(at + sign).is_some_and(u8::is_ascii_digit) {
            at += 1;
            continue;
        }
        let mut end = digits(at + sign);
        if bytes.get(end) == Some(&b'.') && bytes.get(end + 1).is_some_and(u8::is_ascii_digit) {
            end = digits(end + 1);
        }
        if bytes.get(end) == Some(&b'e') {
            let power = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'-' | b'+')));
            end = if digits(power) > power { digits(power) } else { end };
        }
        tokens.push(Token::Words(&line[words..at]));
        tokens.push(Token::Number(&line[at..end]));
        (at, words) = (end, end);
    }
    tokens.push(Token::Words(&line[words..]));
    tokens
}

/// The difference of two numbers, and the allowed one: a relative difference, or one and a half units of the last printed digit if
/// that is more. Dates and frequencies with more digits than a double must agree to 1e-14, a nanosecond. Below 1e-30, less than a
/// millionth of any strain here, a number is the rounding of zero; two digits with an exponent below 1e-9 are an estimated error.
fn apart(found: &str, expected: &str) -> (f64, f64) {
    let parts = |text: &str| -> (f64, f64) {
        let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
        (whole.parse().expect("a whole part"), format!("0.{fraction}").parse().expect("a fraction"))
    };
    let mantissa = expected.split('e').next().expect("a mantissa");
    let figures = mantissa.trim_start_matches(['+', '-', '0', '.']);
    let count = figures.bytes().filter(u8::is_ascii_digit).count();
    if count > 18 && !expected.contains('e') && !found.contains('e') {
        let ((a, b), (c, d)) = (parts(found), parts(expected));
        return (((a - c) + (b - d)).abs(), 1e-14);
    }
    let [found, value] = [found, expected].map(|text| text.parse::<f64>().expect("a number"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let power = expected.split_once('e').map_or(0, |(_, power)| power.parse().expect("a power"));
    let slack = match value.abs() {
        size if size < 1e-30 => 1e-30,
        _ if count == 2 && power < -9 => estimate(found, value),
        _ if decimals == 0 && power == 0 => 0.0,
        _ => 1.5 * 10f64.powi(power - decimals as i32),
    };
    ((found - value).abs(), slack.max(RELATIVE * value.abs()))
}

/// Allowed ratio of two estimated errors: a factor of two, or of ten if they consist of a few roundings.
fn estimate(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if size < 1e-14 { 0.9 * size } else { 0.5 * size }
}

/// Removes spaces and lines that only align a table.
fn squeezed(words: &str) -> String {
    let words = words.replace('─', "");
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Larger tolerances from the comments above a block: `<!-- within 1e-11 -->` for all its numbers, `<!-- E_error within 1e37 -->` for columns
/// with names that begin so, and `<!-- error_estimate estimated -->` for columns of estimated errors.
#[derive(Debug, Clone, Default)]
struct Room<'t> {
    within: Vec<(&'t str, f64)>,
    estimated: Vec<&'t str>,
}

impl<'t> Room<'t> {
    fn of(before: &'t str) -> Self {
        let lines = before.trim_end().lines().rev();
        let comments = lines.map_while(|line| line.strip_prefix("<!-- ")?.strip_suffix(" -->"));
        let mut room = Self::default();
        for comment in comments {
            match (comment.split_once("within "), comment.strip_suffix(" estimated")) {
                (Some((name, size)), _) => room.within.push((name.trim_end(), size.parse().expect("a number"))),
                (None, Some(name)) => room.estimated.push(name),
                (None, None) => panic!("what is `{comment}`?"),
            }
        }
        room
    }

    /// For the numbers of a column.
    fn for_numbers(&self, head: &str, [a, b]: [f64; 2]) -> f64 {
        let within = self.within.iter().filter(|(name, _)| head.starts_with(name)).map(|(_, size)| *size);
        let is_estimated = self.estimated.iter().any(|name| head.starts_with(name));
        within.fold(if is_estimated { estimate(a, b) } else { 0.0 }, f64::max)
    }
}

fn compare(what: &str, found: &[&str], expected: &[&str], room: &Room<'_>) {
    assert_eq!(found.len(), expected.len(), "{what}: other lines are written:\n{}", found.join("\n"));
    let heads: Vec<_> = expected.first().map_or(vec![], |line| line.split(',').collect());
    for (found, expected) in found.iter().zip(expected) {
        let (left, right) = (tokens(found), tokens(expected));
        let differs = || format!("{what}: written is\n{found}\nand on the page stands\n{expected}");
        assert_eq!(left.len(), right.len(), "{}", differs());
        let mut column = 0;
        for pair in left.iter().zip(&right) {
            match pair {
                (Token::Words(a), Token::Words(b)) => {
                    assert_eq!(squeezed(a), squeezed(b), "{}", differs());
                    column += b.matches(',').count();
                }
                (Token::Number(a), Token::Number(b)) => {
                    let head = heads.get(column).filter(|_| heads.len() > 1).copied().unwrap_or_default();
                    let (off, allowed) = apart(a, b);
                    let allowed =
                        allowed.max(room.for_numbers(head, [a, b].map(|text| text.parse().expect("a number"))));
                    assert!(off <= allowed, "{a} is not {b}: off by {off:e}, allowed {allowed:e}. {}", differs());
                }
                _ => panic!("{}", differs()),
            }
        }
    }
}

/// The text between fences, in order: the word after the first fence, the text, and its tolerances.
fn blocks(page: &str) -> Vec<(&str, &str, Room<'_>)> {
    let mut blocks = Vec::new();
    let mut rest = page;
    while let Some((before, after)) = rest.split_once("\n```") {
        let (kind, after) = after.split_once('\n').expect("a line");
        let (text, after) = after.split_once("\n```").expect("a closed block");
        blocks.push((kind, text, Room::of(before)));
        rest = after;
    }
    blocks
}

/// Runs the page from top to bottom in an empty folder; returns the commands and the count of numbers.
fn work_through(page: &str) -> (Vec<String>, usize) {
    let folder = Folder::new();
    let program = Path::new(TWOFOLD).parent().expect("a folder");
    let path = format!("{}:{}", program.display(), env::var("PATH").unwrap_or_default());
    let (mut commands, mut numbers) = (Vec::new(), 0);
    for (kind, text, room) in blocks(page) {
        match kind {
            "toml" => {
                let name = text.lines().next().and_then(|line| line.strip_prefix("# ")).expect("the name of the file");
                fs::write(folder.path().join(name), text).expect("a file");
            }
            "console" => {
                for shown in text.split("\n$ ") {
                    let (command, output) = shown.split_once('\n').unwrap_or((shown, ""));
                    let command = command.trim_start_matches("$ ");
                    let ran =
                        Command::new("sh").args(["-c", command]).env("PATH", &path).current_dir(folder.path()).output();
                    let ran = ran.expect("a shell");
                    let is_note = |line: &&str| line.starts_with("note: ") || line.starts_with("error: ");
                    let (notes, lines): (Vec<_>, Vec<_>) = output.lines().partition(is_note);
                    let (written, told) = (String::from_utf8_lossy(&ran.stdout).into_owned(), stderr(&ran));
                    let is_refused = notes.iter().any(|note| note.starts_with("error: "));
                    assert_eq!(ran.status.success(), !is_refused, "{command}: {told}");
                    compare(command, &written.lines().collect::<Vec<_>>(), &lines, &room);
                    compare(command, &told.lines().collect::<Vec<_>>(), &notes, &room);
                    let all = output.lines().flat_map(tokens);
                    numbers += all.filter(|token| matches!(token, Token::Number(_))).count();
                    commands.push(command.to_owned());
                }
            }
            other => panic!("a block of {other:?}"),
        }
    }
    (commands, numbers)
}

#[test]
fn the_worked_pulsar_is_what_the_commands_write() {
    let (commands, numbers) = work_through(include_str!("../../../docs/worked-pulsar.md"));
    for command in ["run", "pulses", "timing", "fisher", "fit", "forecast", "bounds"] {
        assert!(commands.iter().any(|line| line.starts_with(&format!("twofold {command} "))), "{command}");
    }
    assert!(numbers > 300, "{numbers}");
}

#[test]
fn the_worked_wave_is_what_the_commands_write() {
    let (commands, numbers) = work_through(include_str!("../../../docs/worked-wave.md"));
    for command in ["run", "spectrum", "sweep", "fisher", "fit", "scenes", "timing"] {
        assert!(commands.iter().any(|line| line.starts_with(&format!("twofold {command} "))), "{command}");
    }
    assert!(numbers > 300, "{numbers}");
}

#[test]
fn a_page_that_differs_in_a_digit_a_unit_or_a_line_is_seen() {
    let same = |found: &str, expected: &str| {
        let lines = |text: &'static str| text.lines().collect::<Vec<_>>();
        let (found, expected) = (found.to_owned().leak(), expected.to_owned().leak());
        std::panic::catch_unwind(|| compare("", &lines(found), &lines(expected), &Room::default())).is_ok()
    };
    assert!(same("1.2345678901,-3e-9 [s]", "1.2345678902,-3e-9 [s]"));
    assert!(same("error: 4.7e-14", "error: 4.6e-14") && same("55321.1234567890123456", "55321.1234567890123457"));
    for (found, expected) in [
        ("1.23456789", "1.23456799"),
        ("1.5", "-1.5"),
        ("1.5 [s]", "1.5 [ms]"),
        ("1.5,", "1.5"),
        ("a\nb", "a"),
        ("4.7e-14", "4.7e-13"),
        ("2 pulses", "3 pulses"),
        ("55321.1234567890123456", "55321.1234567890133456"),
        ("e_x1", "e_x2"),
    ] {
        assert!(!same(found, expected), "{found} and {expected}");
    }
}
