//! LaTeX to MathML, which browsers display without scripts.

use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use maud::{Markup, PreEscaped};

pub(super) fn displayed(latex: &str) -> Result<Markup, String> {
    mathml(latex, MathDisplay::Block)
}

/// A formula within a line of text.
pub(super) fn inline(latex: &str) -> Result<Markup, String> {
    mathml(latex, MathDisplay::Inline)
}

fn mathml(latex: &str, display: MathDisplay) -> Result<Markup, String> {
    let why = |error: &dyn std::fmt::Debug| format!("{error:?} in the LaTeX\n{latex}");
    let converter = LatexToMathML::new(MathCoreConfig::default()).map_err(|error| why(&error))?;
    let mathml = converter.convert_with_local_counter(latex, display).map_err(|error| why(&error))?;
    // Chromium sets combining accents beside their letter; later versions of the crate use the characters that are substituted here.
    Ok(PreEscaped(mathml.replace('\u{302}', "\u{2c6}").replace('\u{303}', "\u{2dc}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_latex_is_an_error() {
        for wrong in [r"\frac{1}{2", r"\nosuchcommand x", r"\begin{aligned} x", r"x_a_b"] {
            assert!(displayed(wrong).is_err(), "{wrong}");
        }
        let shown = [displayed("x"), inline("x")].map(|maths| maths.expect("LaTeX").0.contains("display=\"block\""));
        assert_eq!(shown, [true, false]);
        assert!(inline(r"\hat{n} < 1").expect("LaTeX").0.contains("&lt;"), "text is escaped");
    }
}
