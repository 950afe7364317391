//! Formulas within plain text, set as a reader expects them: `alpha_0` with a Greek letter and a subscript, `<=` as one sign.

use maud::{Markup, html};

const SYMBOLS: [(&str, &str); 35] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ϵ"),
    ("eps", "ϵ"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("phi", "ϕ"),
    ("varphi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
    ("DeltaPhi", "ΔΦ"),
    ("<=", "≤"),
    (">=", "≥"),
    ("<~", "≲"),
    ("-+", "∓"),
];

/// A stretch of text in one position.
#[derive(Debug, PartialEq)]
enum Piece<'t> {
    Line(&'t str),
    Below(&'t str),
    Above(&'t str),
}

/// The text with its formulas set.
pub(super) fn typeset(text: &str) -> Markup {
    html! {
        @for piece in pieces(text) {
            @match piece {
                Piece::Line(text) => (text),
                Piece::Below(text) => sub { (text) },
                Piece::Above(text) => sup { (text) },
            }
        }
    }
}

fn pieces(text: &str) -> Vec<Piece<'_>> {
    let (mut pieces, mut rest) = (Vec::new(), text);
    // Whether what stands before is a symbol, whose indices and powers are set, or any word, whose powers are if numbers.
    let (mut symbol, mut word_before) = (false, false);
    while let Some(first) = rest.chars().next() {
        // `beta1` is a letter and a number.
        let end = |kind: fn(char) -> bool| rest.find(|c| !kind(c)).unwrap_or(rest.len());
        let (letters, word) = (&rest[..end(char::is_alphabetic)], &rest[..end(char::is_alphanumeric)]);
        let word = if symbol_of(letters).is_some() { letters } else { word };
        let taken = match first {
            '^' | '_' if word_before => match script(&rest[1..]) {
                Some((script, length)) if symbol || first == '^' && script.parse::<i32>().is_ok() => {
                    let script = symbol_of(script).unwrap_or(script);
                    pieces.push(if first == '^' { Piece::Above(script) } else { Piece::Below(script) });
                    1 + length
                }
                _ => {
                    pieces.push(Piece::Line(&rest[..1]));
                    1
                }
            },
            _ if !word.is_empty() => {
                let letter = symbol_of(word);
                symbol = letter.is_some()
                    || word.chars().count() == 1 && first.is_alphabetic()
                    || ["sin", "cos", "tan", "cot"].contains(&word);
                word_before = true;
                pieces.push(Piece::Line(letter.unwrap_or(word)));
                word.len()
            }
            _ => {
                (symbol, word_before) = (false, false);
                let sign = rest.get(..2).and_then(|sign| Some((sign.len(), symbol_of(sign)?)));
                let (length, sign) = sign.unwrap_or_else(|| (first.len_utf8(), &rest[..first.len_utf8()]));
                pieces.push(Piece::Line(sign));
                length
            }
        };
        rest = &rest[taken..];
    }
    pieces
}

fn symbol_of(word: &str) -> Option<&'static str> {
    SYMBOLS.iter().find(|(name, _)| *name == word).map(|(_, letter)| *letter)
}

/// The index or power at the beginning of `text` without its braces, and the length of what it takes.
fn script(text: &str) -> Option<(&str, usize)> {
    if let Some(inner) = text.strip_prefix('{') {
        return inner.find('}').map(|end| (&inner[..end], end + 2));
    }
    if text.starts_with('(') {
        return text.find(')').map(|end| (&text[..=end], end + 1));
    }
    let sign = usize::from(text.starts_with(['+', '-']));
    let length = sign + text[sign..].bytes().take_while(u8::is_ascii_alphanumeric).count();
    // `h_+` has its sign for an index, `x^-` nothing.
    (length > 0 && text != "-").then_some((&text[..length], length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_set_and_words_are_left_alone() {
        for (text, html) in [
            ("alpha_0 + a^(1) sin^2 beta1", "α<sub>0</sub> + a<sup>(1)</sup> sin<sup>2</sup> β1"),
            ("|s^XX - s^YY| <= 1e-3", "|s<sup>XX</sup> - s<sup>YY</sup>| ≤ 1e-3"),
            (
                "2^61 - 1, t_c^-1, h_+ and h_x",
                "2<sup>61</sup> - 1, t<sub>c</sub><sup>-1</sup>, h<sub>+</sub> and h<sub>x</sub>",
            ),
            (
                "1e15 g/cm^3, I^{IJ} of the Omega^z, eta_beta",
                "1e15 g/cm<sup>3</sup>, I<sup>IJ</sup> of the Ω<sup>z</sup>, η<sub>β</sub>",
            ),
            ("the beta-decay of alphabet_soup, x^", "the β-decay of alphabet_soup, x^"),
            ("é < ü", "é &lt; ü"),
        ] {
            assert_eq!(typeset(text).0, html, "{text}");
        }
    }
}
