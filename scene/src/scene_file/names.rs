//! Names in messages: lists of them, and the name that was probably intended.

/// `` `a`, `b` and `c` ``.
pub fn listed(names: &[&str]) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// A count with its noun: `1 prior` or `2 priors`.
pub fn counted<N: std::fmt::Display + PartialEq + From<u8>>(number: N, noun: &str) -> String {
    let plural = if number == N::from(1) { "" } else { "s" };
    format!("{number} {noun}{plural}")
}

/// The text on one line, without control characters, truncated after 40 characters.
pub fn shortened(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ").replace(char::is_control, "\u{fffd}");
    if line.chars().count() <= 40 { line } else { line.chars().take(37).chain("...".chars()).collect() }
}

/// `` Did you mean `name`?`` with the name that was most probably intended, after a space; empty if none is close.
pub fn did_you_mean(word: &str, names: &[&str]) -> String {
    nearest(word, names).map(|name| format!(" Did you mean `{name}`?")).unwrap_or_default()
}

/// The name that was most probably intended: with at most two wrong letters, or beginning with the word, ignoring case.
pub fn nearest<'n>(word: &str, names: &[&'n str]) -> Option<&'n str> {
    if let Some(name) = names.iter().find(|name| name.eq_ignore_ascii_case(word)) {
        return Some(name);
    }
    let (distance, name) = names.iter().map(|&name| (strsim::levenshtein(word, name), name)).min()?;
    let beginning = || names.iter().copied().find(|name| word.len() > 2 && name.starts_with(word));
    if distance <= 2.min(name.len() / 2) { Some(name) } else { beginning() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_cut_after_forty_characters() {
        assert_eq!(shortened(&"x".repeat(40)), "x".repeat(40));
        assert_eq!(shortened(&"x".repeat(41)), format!("{}...", "x".repeat(37)));
        assert_eq!(shortened(" a\n\t b\u{7} "), "a b\u{fffd}");
    }

    /// Two letters may be wrong, and in a short name no more than half of them.
    #[test]
    fn a_name_is_guessed_from_one_with_two_letters_wrong() {
        let near = |word| nearest(word, &["momentum", "spin", "rho", "w"]);
        assert_eq!(near("momemtun"), Some("momentum"));
        assert_eq!([near("nomemtun"), near("sxxn"), near("sxxx")], [None, Some("spin"), None]);
        assert_eq!([near("who"), near("wha"), near("r")], [Some("rho"), None, None]);
        // The beginning of a name, with at least three letters, and capitals.
        assert_eq!([near("mom"), near("mo"), near("RHO")], [Some("momentum"), None, Some("rho")]);
    }
}
