//! Reading a section of a TOML document key by key, every refusal with its place, the value as written and what is allowed.

use std::ops::Range;

use nalgebra::Vector3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::Fault;

/// Numbers that stand in place of those written, each with the dotted key of one, such as `lorentz_violation.w[2]`.
#[derive(Clone, Copy)]
pub(crate) struct Replaced<'a> {
    /// The keys.
    pub(crate) keys: &'a [String],
    /// A number for each.
    pub(crate) numbers: &'a [f64],
}

impl Replaced<'_> {
    /// Everything as written.
    pub(crate) const NOTHING: Self = Self { keys: &[], numbers: &[] };

    fn get(&self, key: &str) -> Option<f64> {
        self.keys.iter().position(|replaced| replaced == key).map(|i| self.numbers[i])
    }
}

/// A table of the document.
pub(crate) struct Section<'a> {
    text: &'a str,
    replaced: Replaced<'a>,
    /// What the document is: `a scene`.
    document: &'static str,
    /// Dotted name; empty for the document itself.
    name: String,
    span: Range<usize>,
    table: &'a DeTable<'a>,
}

/// A value of a section.
pub(crate) struct Entry<'a> {
    text: &'a str,
    replaced: Replaced<'a>,
    /// Dotted key.
    key: String,
    span: Range<usize>,
    value: &'a DeValue<'a>,
}

impl<'a> Section<'a> {
    /// The document itself, which messages call `document`.
    pub(crate) fn document(text: &'a str, table: &'a DeTable<'a>, document: &'static str) -> Self {
        Self { text, replaced: Replaced::NOTHING, document, name: String::new(), span: 0..0, table }
    }

    /// The same with numbers that stand in place of those written.
    pub(crate) fn replacing(self, replaced: Replaced<'a>) -> Self {
        Self { replaced, ..self }
    }

    fn dotted(&self, key: &str) -> String {
        if self.name.is_empty() { key.to_owned() } else { format!("{}.{key}", self.name) }
    }

    fn title(&self) -> String {
        if self.name.is_empty() { self.document.to_owned() } else { format!("[{}]", self.name) }
    }

    /// Refuses keys that are not in `allowed`.
    pub(crate) fn only(&self, allowed: &[&str]) -> Result<(), Fault> {
        let unknown = self.table.keys().filter(|key| !allowed.contains(&key.get_ref().as_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else { return Ok(()) };
        let guess = nearest(key.get_ref(), allowed).map(|near| format!(" Did you mean `{near}`?")).unwrap_or_default();
        Err(Fault::at(
            key.span(),
            format!(
                "unknown key `{}`: {} has {}.{guess}",
                self.dotted(&shortened(key.get_ref())),
                self.title(),
                listed(allowed)
            ),
        ))
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.find(key).is_some()
    }

    fn find(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.table.iter().find(|(k, _)| k.get_ref() == key).map(|(_, value)| value)
    }

    /// The value of `key`, if it is there.
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

    /// The value of `key`; `meaning` is said where it is missing.
    pub(crate) fn required(&self, key: &str, meaning: &str) -> Result<Entry<'a>, Fault> {
        self.optional(key).ok_or_else(|| self.missing(&format!("`{}` ({meaning})", self.dotted(key))))
    }

    /// A refusal because something is missing from the section.
    pub(crate) fn missing(&self, what: &str) -> Fault {
        self.fault(format!("missing {what}"))
    }

    /// A refusal of the section as a whole.
    pub(crate) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault { span: (!self.name.is_empty()).then(|| self.span.clone()), message: message.into() }
    }

    /// Refuses `second` beside `first`, which say the same thing in two ways.
    pub(crate) fn not_both(&self, first: &str, second: &str) -> Result<(), Fault> {
        match (self.find(first), self.find(second)) {
            (Some(_), Some(value)) => Err(Fault::at(
                value.span(),
                format!("`{}` beside `{}`: only one of the two is allowed", self.dotted(second), self.dotted(first)),
            )),
            _ => Ok(()),
        }
    }

    /// The section `key`, if it is there.
    pub(crate) fn section(&self, key: &str) -> Result<Option<Section<'a>>, Fault> {
        let Some(entry) = self.optional(key) else { return Ok(None) };
        let refusal = entry.refuse(&format!("a section, written [{}]", entry.key));
        self.of_table(entry).map(Some).ok_or(refusal)
    }

    fn of_table(&self, entry: Entry<'a>) -> Option<Section<'a>> {
        let DeValue::Table(table) = entry.value else { return None };
        let Entry { text, replaced, key: name, span, .. } = entry;
        Some(Section { text, replaced, document: self.document, name, span, table })
    }

    /// The table `key`, written as a section or inside braces, if it is there; `allowed` says of what.
    pub(crate) fn table(&self, key: &str, allowed: &str) -> Result<Option<Section<'a>>, Fault> {
        let Some(entry) = self.optional(key) else { return Ok(None) };
        let refusal = entry.refuse(allowed);
        self.of_table(entry).map(Some).ok_or(refusal)
    }

    /// The sections `key`, each written `[[key]]`, one at least; `meaning` is said where they are missing.
    pub(crate) fn repeated_section(&self, key: &str, meaning: &str) -> Result<Vec<Section<'a>>, Fault> {
        let allowed = format!("sections, each written [[{key}]]");
        let missing = || self.missing(&format!("section [[{key}]] ({meaning})"));
        let list = self.optional(key).ok_or_else(missing)?;
        let entries = list.list(&allowed)?;
        if entries.is_empty() {
            return Err(list.refuse(&allowed));
        }
        entries.into_iter().map(|entry| self.of_table(entry).ok_or_else(|| list.refuse(&allowed))).collect()
    }

    /// The section `key`; `meaning` is said where it is missing.
    pub(crate) fn required_section(&self, key: &str, meaning: &str) -> Result<Section<'a>, Fault> {
        self.section(key)?.ok_or_else(|| self.missing(&format!("section [{key}] ({meaning})")))
    }
}

impl<'a> Entry<'a> {
    /// A refusal of the value.
    pub(crate) fn refuse(&self, allowed: &str) -> Fault {
        self.refuse_because(&format!("allowed is {allowed}"))
    }

    /// A refusal of the value for a reason that lies elsewhere in the scene.
    pub(crate) fn refuse_because(&self, why: &str) -> Fault {
        let written = shortened(self.text.get(self.span.clone()).unwrap_or(""));
        let value = self.replaced.get(&self.key).map_or(written, |number| format!("{number:?}"));
        Fault::at(self.span.clone(), format!("`{}` = {value}: {why}", self.key))
    }

    /// A finite number.
    pub(crate) fn number(&self) -> Result<f64, Fault> {
        if let Some(number) = self.replaced.get(&self.key) {
            return if number.is_finite() { Ok(number) } else { Err(self.refuse("a finite number")) };
        }
        match self.value {
            DeValue::Float(float) => float.as_str().parse().ok().filter(|x: &f64| x.is_finite()),
            DeValue::Integer(integer) if integer.radix() == 10 => {
                integer.as_str().parse().ok().filter(|x: &f64| x.is_finite())
            }
            _ => None,
        }
        .ok_or_else(|| self.refuse("a finite decimal number"))
    }

    /// Half of the unit of the last digit written: the largest error of a number that was rounded to it.
    pub(crate) fn rounding(&self) -> f64 {
        let text = self.text.get(self.span.clone()).unwrap_or("").replace('_', "").to_ascii_lowercase();
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
        exponent.parse::<f64>().map_or(0.0, |exponent| 0.5 * 10f64.powf(exponent - decimals as f64))
    }

    /// An angle in radians. Beyond a million, more than six digits of its place on the circle are lost.
    pub(crate) fn angle(&self) -> Result<f64, Fault> {
        self.number_where("an angle of at most 1e6 in size [rad]", |x| x.abs() <= 1e6)
    }

    /// A finite number for which `holds`.
    pub(crate) fn number_where(&self, allowed: &str, holds: impl Fn(f64) -> bool) -> Result<f64, Fault> {
        let x = self.number()?;
        if holds(x) { Ok(x) } else { Err(self.refuse(allowed)) }
    }

    /// A whole number from `low` to `high`.
    pub(crate) fn whole_number(&self, low: usize, high: usize) -> Result<usize, Fault> {
        match self.value {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            _ => None,
        }
        .filter(|n| (low..=high).contains(n))
        .ok_or_else(|| self.refuse(&format!("a whole number from {low} to {high}")))
    }

    /// `true` or `false`.
    pub(crate) fn boolean(&self) -> Result<bool, Fault> {
        match self.value {
            DeValue::Boolean(value) => Ok(*value),
            _ => Err(self.refuse("true or false")),
        }
    }

    /// A string.
    pub(crate) fn string(&self) -> Result<&'a str, Fault> {
        match self.value {
            DeValue::String(string) => Ok(string),
            _ => Err(self.refuse("a string in quotes")),
        }
    }

    /// A string out of `allowed`.
    pub(crate) fn word(&self, allowed: &[&str]) -> Result<&'a str, Fault> {
        let quoted = || allowed.iter().map(|w| format!("\"{w}\"")).collect::<Vec<_>>().join(", ");
        match self.value {
            DeValue::String(word) if allowed.contains(&word.as_ref()) => Ok(word),
            _ => Err(self.refuse(&format!("one of {}", quoted()))),
        }
    }

    /// Whether the value is a list.
    pub(crate) fn is_list(&self) -> bool {
        matches!(self.value, DeValue::Array(_))
    }

    /// The entries of a list; `allowed` says of what.
    pub(crate) fn list(&self, allowed: &str) -> Result<Vec<Entry<'a>>, Fault> {
        let DeValue::Array(array) = self.value else { return Err(self.refuse(allowed)) };
        let entry = |(i, value): (usize, &'a Spanned<DeValue<'a>>)| Entry {
            text: self.text,
            replaced: self.replaced,
            key: format!("{}[{i}]", self.key),
            span: value.span(),
            value: value.get_ref(),
        };
        Ok(array.iter().enumerate().map(entry).collect())
    }

    /// Whether the value is a string.
    pub(crate) fn is_string(&self) -> bool {
        matches!(self.value, DeValue::String(_))
    }

    /// Appends the dotted keys of the decimal numbers that the value is or holds.
    fn numbers(&self, keys: &mut Vec<String>) {
        match self.value {
            DeValue::Float(_) => keys.push(self.key.clone()),
            DeValue::Integer(integer) if integer.radix() == 10 => keys.push(self.key.clone()),
            DeValue::Array(_) => self.list("").into_iter().flatten().for_each(|entry| entry.numbers(keys)),
            _ => {}
        }
    }

    /// Three finite numbers.
    pub(crate) fn vector(&self, allowed: &str) -> Result<Vector3<f64>, Fault> {
        let entries = self.list(allowed)?;
        if entries.len() != 3 {
            return Err(self.refuse(allowed));
        }
        Ok(Vector3::new(entries[0].number()?, entries[1].number()?, entries[2].number()?))
    }
}

/// `` `a`, `b` and `c` ``.
pub fn listed(names: &[&str]) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// The text on one line, without control characters, cut after 40 characters.
pub fn shortened(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ").replace(char::is_control, "\u{fffd}");
    if line.chars().count() <= 40 { line } else { line.chars().take(37).chain("...".chars()).collect() }
}

/// The name that is most probably meant: at most two letters wrong, or the beginning of a name, in capitals or not.
pub fn nearest<'n>(word: &str, names: &[&'n str]) -> Option<&'n str> {
    if let Some(name) = names.iter().find(|name| name.eq_ignore_ascii_case(word)) {
        return Some(name);
    }
    let (distance, name) = names.iter().map(|&name| (edit_distance(word, name), name)).min()?;
    let beginning = || names.iter().copied().find(|name| word.len() > 2 && name.starts_with(word));
    if distance <= 2.min(name.len() / 2) { Some(name) } else { beginning() }
}

/// Levenshtein's distance.
fn edit_distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.chars().enumerate() {
            let above = row[j + 1];
            row[j + 1] = (diagonal + usize::from(x != y)).min(above + 1).min(row[j] + 1);
            diagonal = above;
        }
    }
    row[b.chars().count()]
}
