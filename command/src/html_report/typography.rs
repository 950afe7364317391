//! Formulas within plain text, typeset as a reader expects: `alpha_0` with a Greek letter and a subscript, `<=` as one sign.

use maud::{Markup, html};

/// Names and their symbols, alternating.
const SYMBOLS: &str = "alpha α beta β gamma γ delta δ epsilon ϵ eps ϵ zeta ζ eta η theta θ kappa κ \
    lambda λ mu μ nu ν xi ξ pi π rho ρ sigma σ tau τ phi ϕ varphi φ \
    chi χ psi ψ omega ω Gamma Γ Delta Δ Theta Θ Lambda Λ Phi Φ Psi Ψ Omega Ω \
    DeltaPhi ΔΦ <= ≤ >= ≥ <~ ≲ +- ± -+ ∓ -> →";

/// A stretch of text in one position.
#[derive(Debug, PartialEq)]
enum Piece<'t> {
    Line(&'t str),
    Below(&'t str),
    Above(&'t str),
}

pub(super) fn typeset(text: &str) -> Markup {
    html! {
        @for piece in pieces(text) {
            @match piece {
                Piece::Line(text) => (text),
                Piece::Below(text) => sub { (text.replace('-', "−")) },
                Piece::Above(text) => sup { (text.replace('-', "−")) },
            }
        }
    }
}

fn pieces(text: &str) -> Vec<Piece<'_>> {
    let (mut pieces, mut at) = (Vec::new(), 0);
    // Whether the preceding token is a word, and whether that is a symbol: symbols take all powers and indices, other words only numeric powers.
    let mut word_is_symbol = None;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        // `beta1` is a letter and a number.
        let end = |kind: fn(char) -> bool| rest.find(|c| !kind(c)).unwrap_or(rest.len());
        let (letters, word) = (&rest[..end(char::is_alphabetic)], &rest[..end(char::is_alphanumeric)]);
        let word = if symbol_of(letters).is_some() { letters } else { word };
        let power = power_of_ten(rest).filter(|_| word_is_symbol.is_none());
        at += match (first, word_is_symbol, power) {
            ('^' | '_', Some(symbol), _) => match script(&rest[1..]) {
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
            (_, _, Some((mantissa, exponent, length))) => {
                pieces.push(Piece::Line(mantissa));
                if exponent != "0" {
                    pieces.extend([Piece::Line("×10"), Piece::Above(exponent)]);
                }
                word_is_symbol = Some(false);
                length
            }
            _ if !word.is_empty() => {
                let letter = symbol_of(word);
                let is_symbol = letter.is_some()
                    || word.chars().count() == 1 && first.is_alphabetic()
                    || ["sin", "cos", "tan", "cot"].contains(&word);
                word_is_symbol = Some(is_symbol);
                pieces.push(Piece::Line(letter.unwrap_or(word)));
                word.len()
            }
            _ => {
                word_is_symbol = None;
                let sign = rest.get(..2).and_then(|sign| Some((sign.len(), symbol_of(sign)?)));
                let (length, mut sign) = sign.unwrap_or_else(|| (first.len_utf8(), &rest[..first.len_utf8()]));
                if sign == "-" && is_minus(&text[..at], &rest[1..]) {
                    sign = "−";
                }
                pieces.push(Piece::Line(sign));
                length
            }
        };
    }
    pieces
}

/// Whether the stroke between the two texts is a minus sign, not the hyphen of a word or of a range.
fn is_minus(before: &str, after: &str) -> bool {
    let (before, after) = (before.chars().next_back(), after.chars().next());
    let space_before = before.is_none_or(|c| c.is_whitespace() || "([|=~/".contains(c));
    space_before && after.is_some()
}

/// Mantissa, exponent and length of the number `2e-16` at the beginning of `text`; the part of `2.2e-16` after the point is such a number, too.
fn power_of_ten(text: &str) -> Option<(&str, &str, usize)> {
    let digits = |from: usize| from + text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mantissa = digits(0);
    let exponent = text[mantissa..].starts_with('e').then_some(mantissa + 1)?;
    let first = exponent + usize::from(text[exponent..].starts_with('-'));
    let end = digits(first);
    let at_end = text[end..].chars().next().is_none_or(|c| !c.is_alphanumeric());
    (mantissa > 0 && end > first && at_end).then(|| (&text[..mantissa], &text[exponent..end], end))
}

fn symbol_of(word: &str) -> Option<&'static str> {
    let mut words = SYMBOLS.split(' ');
    std::iter::from_fn(|| words.next().zip(words.next())).find(|(name, _)| *name == word).map(|(_, letter)| letter)
}

/// The index or power at the beginning of `text` without its braces, and its length.
fn script(text: &str) -> Option<(&str, usize)> {
    if let Some(inner) = text.strip_prefix('{') {
        return inner.find('}').map(|end| (&inner[..end], end + 2));
    }
    if text.starts_with('(') {
        return text.find(')').map(|end| (&text[..=end], end + 1));
    }
    let sign = usize::from(text.starts_with(['+', '-']));
    let length = sign + text[sign..].bytes().take_while(u8::is_ascii_alphanumeric).count();
    // The sign of `h_+` is an index, that of `x^-` is not.
    (length > 0 && text != "-").then_some((&text[..length], length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_set_and_words_are_left_alone() {
        for (text, html) in [
            ("alpha_0 + a^(1) sin^2 beta1", "α<sub>0</sub> + a<sup>(1)</sup> sin<sup>2</sup> β1"),
            ("|s^XX - s^YY| <= 1e-3", "|s<sup>XX</sup> − s<sup>YY</sup>| ≤ 1×10<sup>−3</sup>"),
            ("-1.50e0 in [-0.5, 2.2e-16]", "−1.50 in [−0.5, 2.2×10<sup>−16</sup>]"),
            ("Euler-Lagrange, tp-I, (11)-(15), 2e, 1e5x", "Euler-Lagrange, tp-I, (11)-(15), 2e, 1e5x"),
            (
                "2^61 - 1, t_c^-1, h_+ and h_x",
                "2<sup>61</sup> − 1, t<sub>c</sub><sup>−1</sup>, h<sub>+</sub> and h<sub>x</sub>",
            ),
            (
                "1e15 g/cm^3, I^{IJ} of the Omega^z, eta_beta",
                "1×10<sup>15</sup> g/cm<sup>3</sup>, I<sup>IJ</sup> of the Ω<sup>z</sup>, η<sub>β</sub>",
            ),
            ("the beta-decay of alphabet_soup, x^", "the β-decay of alphabet_soup, x^"),
            ("é < ü", "é &lt; ü"),
            ("1e- e5 1e3^x 7e-2é 12.50e-3", "1e- e5 1×10<sup>3</sup>^x 7e-2é 12.50×10<sup>−3</sup>"),
        ] {
            assert_eq!(typeset(text).0, html, "{text}");
        }
    }
}
