//! The input of a sweep's table, which determines whether a partial table can be continued.

use std::ops::Range;

use serde_json::{Value, json};

use super::SweepText;

/// Everything that the bytes of a table depend on: the program, the texts and the range of scenes.
#[derive(Debug, Clone, PartialEq)]
pub struct Identity {
    file: String,
    facts: Value,
}

impl Identity {
    /// The identity of the scenes `scenes` of a sweep, computed by this program.
    pub fn new(text: &SweepText, scenes: &Range<u64>) -> Self {
        let facts = json!({
            "journal": 1,
            "program": concat!("twofold ", env!("CARGO_PKG_VERSION"), " for ", env!("TWOFOLD_TARGET")),
            "scenes": [scenes.start, scenes.end],
            "sweep": text.text,
            "scene": text.scene.as_ref().map(|(_, text)| text),
        });
        Self { file: text.file.clone(), facts }
    }

    pub(super) fn facts(&self) -> &Value {
        &self.facts
    }

    /// The difference between a journal's sweep and this one, in words, if there is any.
    pub(super) fn difference_from(&self, journal: &Value) -> Option<String> {
        if *journal == self.facts {
            return None;
        }
        let differs = |key: &str| journal[key] != self.facts[key];
        Some(if differs("journal") || differs("program") {
            format!("it was begun by {}, but this is {}", journal["program"], self.facts["program"])
        } else if differs("sweep") {
            changed_line(&format!("the sweep file {}", self.file), &journal["sweep"], &self.facts["sweep"])
        } else if differs("scene") {
            changed_line("the scene", &journal["scene"], &self.facts["scene"])
        } else {
            format!("it holds the scenes {} (from, to), not {}", journal["scenes"], self.facts["scenes"])
        })
    }
}

/// Names the first line in which two texts differ.
fn changed_line(what: &str, then: &Value, now: &Value) -> String {
    let (then, now) = (then.as_str().unwrap_or(""), now.as_str().unwrap_or(""));
    let same = then.lines().zip(now.lines()).take_while(|(then, now)| then == now).count();
    let line = |text: &str| text.lines().nth(same).map_or("missing".to_owned(), |line| format!("`{}`", line.trim()));
    format!("{what} has changed since: line {} was {} and is {}", same + 1, line(then), line(now))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All inputs that determine the bytes are compared, and named with the line if possible; the name of a scene alone does
    /// not count.
    #[test]
    fn a_table_is_continued_with_the_same_texts_alone() {
        let of = |sweep: &str, scene: Option<&str>, scenes: Range<u64>| {
            let scene = scene.map(|text| ("star.toml".to_owned(), text.to_owned()));
            Identity::new(&SweepText { file: "grid.toml".into(), text: sweep.to_owned(), scene }, &scenes)
        };
        let begun = of("a = 1\nb = 2\n", Some("c = 3\nd = 4\n"), 0..10);
        let difference = |now: Identity| now.difference_from(begun.facts());
        assert_eq!(difference(begun.clone()), None);
        // A table of another version of the program is not continued.
        let mut earlier = begun.facts().clone();
        let program = earlier["program"].as_str().expect("a text").replace(env!("CARGO_PKG_VERSION"), "0.0.1");
        earlier["program"] = program.into();
        let told = begun.difference_from(&earlier).expect("another program");
        assert!(told.starts_with("it was begun by \"twofold 0.0.1 "), "{told}");
        for (now, told) in [
            (
                of("a = 1\nb = 3\n", Some("c = 3\nd = 4\n"), 0..10),
                "the sweep file grid.toml has changed since: line 2 was `b = 2` and is `b = 3`",
            ),
            (
                of("a = 1\nb = 2\n", Some("c = 3\n"), 0..10),
                "the scene has changed since: line 2 was `d = 4` and is missing",
            ),
            (
                of("a = 1\nb = 2\n", Some("x\nc = 3\nd = 4\n"), 0..10),
                "the scene has changed since: line 1 was `c = 3` and is `x`",
            ),
            (of("a = 1\nb = 2\n", Some("c = 3\nd = 4\n"), 0..9), "it holds the scenes [0,10] (from, to), not [0,9]"),
        ] {
            assert_eq!(difference(now).as_deref(), Some(told));
        }
    }
}
