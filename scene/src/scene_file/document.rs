//! TOML documents of any kind, read key by key. Every error message gives the place in the file, the value as written and the
//! allowed values.

use std::fs::File;
use std::ops::{Range, RangeInclusive};
use std::path::Path;

use nalgebra::Vector3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::fault::{Fault, SceneError};
use super::names::{did_you_mean, listed, nearest, shortened};
use crate::sweep::SWEEPS;
use crate::text_file::read_text;

type Names = fn() -> Vec<&'static str>;

pub(crate) struct FileFormat {
    /// Name of the kind in messages, with the article: `a scene`.
    pub(crate) name: &'static str,
    /// The names of the built-in files of this kind and the command that lists them, if there are any.
    pub(crate) built_in: Option<(Names, &'static str)>,
}

impl FileFormat {
    /// The text of a file, with its size bounded while reading, so that a device or pipe cannot fill the memory.
    pub(crate) fn read(&self, path: &str) -> Result<String, SceneError> {
        let refuse = |message: String| SceneError::of_file(path, message);
        let name = self.name;
        if Path::new(path).is_dir() {
            let or =
                self.built_in.map(|(_, command)| format!(" or a built-in name (see `{command}`)")).unwrap_or_default();
            return Err(refuse(format!("is a directory; {name} must be a TOML file{or}")));
        }
        let file = File::open(path).map_err(|error| {
            if SWEEPS.iter().any(|sweep| sweep.name == path) {
                return refuse(format!(
                    "is a built-in sweep; write its file with `twofold scenes --print {path} > {path}.toml`"
                ));
            }
            let Some((names, _)) = self.built_in else {
                return refuse(format!("is not a readable file ({error})"));
            };
            let (names, noun) = (names(), name.trim_start_matches("a "));
            let guess = match nearest(path, &names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the built-in {noun}s are {}", listed(&names)),
            };
            refuse(format!("neither a built-in {noun} nor a readable file ({error}); {guess}"))
        })?;
        read_text(file).map_err(refuse)
    }

    /// The result of `read` for the document with the text of `file`.
    pub(crate) fn parse<T>(
        &self,
        file: &str,
        text: &str,
        read: impl FnOnce(&Section<'_>) -> Result<T, Fault>,
    ) -> Result<T, SceneError> {
        let table = self.table(file, text)?;
        read(&Section::document(text, &table, self.name)).map_err(|fault| SceneError::in_text(file, text, fault))
    }

    /// The document with the text of `file`.
    pub(crate) fn table<'t>(&self, file: &str, text: &'t str) -> Result<DeTable<'t>, SceneError> {
        DeTable::parse(text).map(Spanned::into_inner).map_err(|syntax| {
            let message = syntax.message().trim().replace('\n', ", ");
            let fault = Fault { span: syntax.span(), message: format!("not TOML: {message}") };
            SceneError::in_text(file, text, fault)
        })
    }
}

/// Numbers that replace those in the document, each with the dotted key of one, such as `lorentz_violation.w[2]`.
#[derive(Clone, Copy)]
pub(crate) struct Replaced<'a> {
    pub(crate) keys: &'a [String],
    pub(crate) numbers: &'a [f64],
}

impl Replaced<'_> {
    pub(crate) const NOTHING: Self = Self { keys: &[], numbers: &[] };

    fn get(&self, key: &str) -> Option<f64> {
        self.keys.iter().position(|replaced| replaced == key).map(|i| self.numbers[i])
    }
}

pub(crate) struct Section<'a> {
    text: &'a str,
    replaced: Replaced<'a>,
    /// Kind of the document: `a scene`.
    document: &'static str,
    /// Dotted name; empty for the document itself.
    name: String,
    span: Range<usize>,
    table: &'a DeTable<'a>,
}

pub(crate) struct Entry<'a> {
    text: &'a str,
    replaced: Replaced<'a>,
    key: String,
    span: Range<usize>,
    value: &'a DeValue<'a>,
}

impl<'a> Section<'a> {
    /// The document itself, which error messages call `document`.
    pub(crate) fn document(text: &'a str, table: &'a DeTable<'a>, document: &'static str) -> Self {
        Self { text, replaced: Replaced::NOTHING, document, name: String::new(), span: 0..0, table }
    }

    /// The same with numbers that replace those in the document.
    pub(crate) fn replacing(self, replaced: Replaced<'a>) -> Self {
        Self { replaced, ..self }
    }

    fn dotted(&self, key: &str) -> String {
        if self.name.is_empty() { key.to_owned() } else { format!("{}.{key}", self.name) }
    }

    fn title(&self) -> String {
        if self.name.is_empty() { self.document.to_owned() } else { format!("[{}]", self.name) }
    }

    /// Refuses keys that are not among the words of `allowed`.
    pub(crate) fn only(&self, allowed: &str) -> Result<(), Fault> {
        let unknown = self.table.keys().filter(|key| allowed.split(' ').all(|word| word != key.get_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else { return Ok(()) };
        let allowed: Vec<_> = allowed.split(' ').collect();
        let (name, title) = (key.get_ref(), self.title());
        let (dotted, guess) = (self.dotted(&shortened(name)), did_you_mean(name, &allowed));
        Err(Fault::at(
            key.span(),
            format!("unknown key `{dotted}`; the keys of {title} are {}.{guess}", listed(&allowed)),
        ))
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.find(key).is_some()
    }

    fn find(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.table.iter().find(|(k, _)| k.get_ref() == key).map(|(_, value)| value)
    }

    pub(crate) fn number_or(&self, key: &str, default: f64) -> Result<f64, Fault> {
        self.optional(key).map_or(Ok(default), |entry| entry.number())
    }

    pub(crate) fn optional_string(&self, key: &str) -> Result<Option<&'a str>, Fault> {
        self.optional(key).map(|entry| entry.string()).transpose()
    }

    pub(crate) fn optional(&self, key: &str) -> Option<Entry<'a>> {
        let value = self.find(key)?;
        Some(self.entry(key, value))
    }

    fn entry(&self, key: &str, value: &'a Spanned<DeValue<'a>>) -> Entry<'a> {
        let (text, replaced, key) = (self.text, self.replaced, self.dotted(key));
        Entry { text, replaced, key, span: value.span(), value: value.get_ref() }
    }

    /// The dotted keys of all decimal numbers in the section and inside its values.
    pub(crate) fn numbers(&self) -> Vec<String> {
        let mut keys = Vec::new();
        for (key, value) in self.table {
            self.entry(key.get_ref(), value).numbers(&mut keys);
        }
        keys
    }

    /// The value of `key`; `meaning` is part of the message if it is missing.
    pub(crate) fn required(&self, key: &str, meaning: &str) -> Result<Entry<'a>, Fault> {
        self.optional(key).ok_or_else(|| self.missing(&format!("`{}` ({meaning})", self.dotted(key))))
    }

    /// An error because something is missing from the section.
    pub(crate) fn missing(&self, what: &str) -> Fault {
        self.fault(format!("missing {what}"))
    }

    /// An error for the section as a whole.
    pub(crate) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault { span: (!self.name.is_empty()).then(|| self.span.clone()), message: message.into() }
    }

    /// Refuses the second key of a pair if the first is given too: both are forms of one quantity.
    pub(crate) fn not_both(&self, pairs: &[(&str, &str)]) -> Result<(), Fault> {
        for (first, second) in pairs {
            if let (Some(_), Some(value)) = (self.find(first), self.find(second)) {
                let (first, second) = (self.dotted(first), self.dotted(second));
                let why = format!("`{second}` cannot be used with `{first}`; give only one of the two");
                return Err(Fault::at(value.span(), why));
            }
        }
        Ok(())
    }

    pub(crate) fn section(&self, key: &str) -> Result<Option<Section<'a>>, Fault> {
        self.table(key, &format!("a section, written [{}]", self.dotted(key)))
    }

    fn of_table(&self, entry: Entry<'a>) -> Option<Section<'a>> {
        let DeValue::Table(table) = entry.value else { return None };
        let Entry { text, replaced, key: name, span, .. } = entry;
        Some(Section { text, replaced, document: self.document, name, span, table })
    }

    /// The table `key`, written as a section or inside braces, if it is present; `allowed` describes its content.
    pub(crate) fn table(&self, key: &str, allowed: &str) -> Result<Option<Section<'a>>, Fault> {
        let Some(entry) = self.optional(key) else { return Ok(None) };
        let refusal = entry.refuse(allowed);
        self.of_table(entry).map(Some).ok_or(refusal)
    }

    /// The sections `key`, each written `[[key]]`, at least one; `meaning` is part of the message if they are missing.
    pub(crate) fn repeated_section(&self, key: &str, meaning: &str) -> Result<Vec<Section<'a>>, Fault> {
        let allowed = format!("one or more sections, each written [[{key}]]");
        let missing = || self.missing(&format!("section [[{key}]] ({meaning})"));
        let list = self.optional(key).ok_or_else(missing)?;
        let entries = list.list(&allowed)?;
        if entries.is_empty() {
            return Err(list.refuse(&allowed));
        }
        entries.into_iter().map(|entry| self.of_table(entry).ok_or_else(|| list.refuse(&allowed))).collect()
    }

    /// The section `key`; `meaning` is part of the message if it is missing.
    pub(crate) fn required_section(&self, key: &str, meaning: &str) -> Result<Section<'a>, Fault> {
        self.section(key)?.ok_or_else(|| self.missing(&format!("section [{key}] ({meaning})")))
    }
}

impl<'a> Entry<'a> {
    pub(crate) fn refuse(&self, allowed: &str) -> Fault {
        self.refuse_because(&format!("must be {allowed}"))
    }

    /// Refuses the value for a reason elsewhere in the scene.
    pub(crate) fn refuse_because(&self, why: &str) -> Fault {
        Fault::at(self.span.clone(), format!("`{}` = {}: {why}", self.key, self.shown()))
    }

    /// The value with the numbers that replace those in it, or as it is written.
    fn shown(&self) -> String {
        let inside = format!("{}[", self.key);
        if let Some(number) = self.replaced.get(&self.key) {
            format!("{number:?}")
        } else if self.replaced.keys.iter().any(|key| key.starts_with(&inside)) {
            let entries = self.list("").into_iter().flatten().map(|entry| entry.shown());
            format!("[{}]", entries.collect::<Vec<_>>().join(", "))
        } else {
            shortened(self.text.get(self.span.clone()).unwrap_or(""))
        }
    }

    pub(crate) fn number(&self) -> Result<f64, Fault> {
        if let Some(number) = self.replaced.get(&self.key) {
            return if number.is_finite() { Ok(number) } else { Err(self.refuse("a finite number")) };
        }
        let text = match self.value {
            DeValue::Float(float) => float.as_str(),
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
            _ => "",
        };
        text.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| self.refuse("a finite decimal number"))
    }

    /// Half of the unit of the last digit written: the largest rounding error of the number.
    pub(crate) fn rounding(&self) -> f64 {
        let text = self.text.get(self.span.clone()).unwrap_or("").replace('_', "").to_ascii_lowercase();
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
        exponent.parse::<f64>().map_or(0.0, |exponent| 0.5 * 10f64.powf(exponent - decimals as f64))
    }

    /// An angle in radians. Above a million rad more than six digits of its position on the circle are lost.
    pub(crate) fn angle(&self) -> Result<f64, Fault> {
        self.angle_where("an angle of at most 1e6 in size [rad]", |x| x.abs() <= 1e6)
    }

    /// An angle for which `holds` is true: a number of radians, or degrees as text, `"89.0 deg"`.
    pub(crate) fn angle_where(&self, allowed: &str, holds: impl Fn(f64) -> bool) -> Result<f64, Fault> {
        let angle = match self.value {
            DeValue::String(text) if self.replaced.get(&self.key).is_none() => {
                let degrees = text.strip_suffix("deg").and_then(|number| number.trim_end().parse().ok());
                let degrees = degrees.filter(|degrees: &f64| degrees.is_finite());
                degrees.ok_or_else(|| self.refuse(&format!("{allowed}, or degrees as in \"89.0 deg\"")))?.to_radians()
            }
            _ => self.number()?,
        };
        if holds(angle) { Ok(angle) } else { Err(self.refuse(allowed)) }
    }

    /// A finite number for which `holds` is true.
    pub(crate) fn number_where(&self, allowed: &str, holds: impl Fn(f64) -> bool) -> Result<f64, Fault> {
        let x = self.number()?;
        if holds(x) { Ok(x) } else { Err(self.refuse(allowed)) }
    }

    pub(crate) fn number_in(&self, allowed: &str, range: RangeInclusive<f64>) -> Result<f64, Fault> {
        self.number_where(allowed, |x| range.contains(&x))
    }

    pub(crate) fn whole_number(&self, low: usize, high: usize) -> Result<usize, Fault> {
        match self.value {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            _ => None,
        }
        .filter(|n| (low..=high).contains(n))
        .ok_or_else(|| self.refuse(&format!("a whole number from {low} to {high}")))
    }

    pub(crate) fn boolean(&self) -> Result<bool, Fault> {
        match self.value {
            DeValue::Boolean(value) => Ok(*value),
            _ => Err(self.refuse("true or false")),
        }
    }

    pub(crate) fn string(&self) -> Result<&'a str, Fault> {
        match self.value {
            DeValue::String(string) => Ok(string),
            _ => Err(self.refuse("a string in quotes")),
        }
    }

    /// Different words from `names`, each with its entry; an empty list is allowed.
    pub(crate) fn words(&self, names: &[&str]) -> Result<Vec<(Entry<'a>, &'a str)>, Fault> {
        let allowed = format!("a list of different names from \"{}\"", names.join("\", \""));
        let mut found: Vec<(Entry<'a>, &str)> = Vec::new();
        for entry in self.list(&allowed)? {
            let word = entry.word(names)?;
            if found.iter().any(|(_, other)| *other == word) {
                return Err(entry.refuse_because(&format!("is given twice; expected {allowed}")));
            }
            found.push((entry, word));
        }
        Ok(found)
    }

    /// A string from `allowed`.
    pub(crate) fn word(&self, allowed: &[&str]) -> Result<&'a str, Fault> {
        let quoted = || allowed.iter().map(|w| format!("\"{w}\"")).collect::<Vec<_>>().join(", ");
        match self.value {
            DeValue::String(word) if allowed.contains(&word.as_ref()) => Ok(word),
            _ => Err(self.refuse(&format!("one of {}", quoted()))),
        }
    }

    pub(crate) fn is_list(&self) -> bool {
        matches!(self.value, DeValue::Array(_))
    }

    /// The entries of a list; `allowed` describes them.
    pub(crate) fn list(&self, allowed: &str) -> Result<Vec<Entry<'a>>, Fault> {
        let DeValue::Array(array) = self.value else { return Err(self.refuse(allowed)) };
        let entry = |(i, value): (usize, &'a Spanned<DeValue<'a>>)| {
            let key = format!("{}[{i}]", self.key);
            Entry { key, span: value.span(), value: value.get_ref(), ..*self }
        };
        Ok(array.iter().enumerate().map(entry).collect())
    }

    pub(crate) fn is_string(&self) -> bool {
        matches!(self.value, DeValue::String(_))
    }

    /// Appends the dotted keys of the decimal numbers in the value.
    fn numbers(&self, keys: &mut Vec<String>) {
        match self.value {
            DeValue::Float(_) => keys.push(self.key.clone()),
            DeValue::Integer(integer) if integer.radix() == 10 => keys.push(self.key.clone()),
            DeValue::Array(_) => self.list("").into_iter().flatten().for_each(|entry| entry.numbers(keys)),
            _ => {}
        }
    }

    pub(crate) fn vector(&self, allowed: &str) -> Result<Vector3<f64>, Fault> {
        let entries = self.list(allowed)?;
        if entries.len() != 3 {
            return Err(self.refuse(allowed));
        }
        Ok(Vector3::new(entries[0].number()?, entries[1].number()?, entries[2].number()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEET: FileFormat = FileFormat { name: "a sheet", built_in: None };

    /// The result of `read` for a document, or the error message.
    fn read<T>(text: &str, read: impl FnOnce(&Section<'_>) -> Result<T, Fault>) -> Result<T, String> {
        SHEET.parse("sheet.toml", text, read).map_err(String::from)
    }

    #[test]
    fn angles_are_taken_up_to_a_million() {
        let angle = |text: &str| read(&format!("a = {text}"), |document| document.required("a", "")?.angle());
        assert_eq!(angle("1e6"), Ok(1e6));
        assert_eq!(angle("-1e6"), Ok(-1e6));
        assert_eq!(angle("\"90 deg\""), Ok(std::f64::consts::FRAC_PI_2));
        for beyond in ["1.000001e6", "-1.000001e6", "\"5.8e7 deg\""] {
            assert!(angle(beyond).is_err_and(|why| why.contains("at most 1e6 in size")), "{beyond}");
        }
    }

    /// Numbers in tables and lists have dotted keys; a hexadecimal number is not a decimal one.
    #[test]
    fn decimal_numbers_are_found_with_their_keys() {
        let text = "a = 1\nb = [2.0, [3, 4e1]]\nc = 0x10\nd = \"5\"\n";
        let keys = ["a", "b[0]", "b[1][0]", "b[1][1]"].map(String::from);
        assert_eq!(read(text, |document| Ok(document.numbers())), Ok(keys.to_vec()));
    }
}
