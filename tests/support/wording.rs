//! The words that users see: those of STYLE.md's right column and of former versions must not return.

/// Phrases that must not occur, as whole words in any case.
const REJECTED: &[&str] = &[
    // Terms of the glossary that were replaced.
    "picture is traced",
    "passes over a picture",
    "keep each other company",
    "ask for ahead",
    "made ready",
    "walk",
    "walks",
    "what waits",
    "foretold",
    "is told",
    "put down",
    "take back",
    "worked out",
    "held against",
    "hither",
    "cut-off",
    "whom",
    "unless told otherwise",
    "lanes",
    // "Per", not a distributive "a".
    "nodes a ray",
    "tests a ray",
    "objects a leaf",
    "samples a pixel",
    "rays a pixel",
    // British spelling.
    "colour",
    "colours",
    "centre",
    "centres",
    "centred",
    "grey",
    // Former labels and messages.
    "no command goes by that",
    "previous settings",
    "in seven figures",
    "mean duplication",
    "full volume ratio",
    "references per full leaf",
    "traversal share",
    "clock on the wall",
    "wall-clock",
    "may be compared",
    "may not be compared",
    "make conditions equal",
    "b is on its way",
    "costliest:",
    "interval's begin",
    "nothing new hit",
    "no nearer hit",
    "no split pays",
    "pick no pixel",
    "what was there stays",
    "run trade",
    "rendering takes",
    "forget them",
    "forms:",
    "not so",
    "you predicted",
    "go on",
    "leave the lesson",
    "stands in a leaf",
    "another color",
    "does b take now",
    "another when you ask again",
];

/// Texts that must not stand alone as a label.
const REJECTED_LABELS: &[&str] = &[
    "at most n_oilf objects",
    "ready",
    "complete",
    "finished",
    "linked",
    "judge",
    "trade",
    "left out",
    "d_max",
    "n_oilf",
    "d_arec",
];

/// Returns the phrase for which a text is rejected; `None` if it is fine.
pub fn rejected(text: &str) -> Option<&'static str> {
    let lower = text
        .to_lowercase()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    let label = REJECTED_LABELS.iter().find(|label| lower == **label);
    let is_part_of_word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    let occurs = |phrase: &str| {
        lower.match_indices(phrase).any(|(at, found)| {
            let (before, after) = (&lower[..at], &lower[at + found.len()..]);
            let ends_in_word = found.ends_with(char::is_alphanumeric);
            let continues = is_part_of_word(before.chars().next_back())
                || ends_in_word && is_part_of_word(after.chars().next());
            !continues
        })
    };
    label
        .or_else(|| REJECTED.iter().find(|phrase| occurs(phrase)))
        .copied()
}

/// Asserts that no text is rejected. Each is a place, for the message, and a text.
pub fn assert_plain<P: std::fmt::Display, T: AsRef<str>>(texts: impl IntoIterator<Item = (P, T)>) {
    let mut count = 0;
    let mut wrong = Vec::new();
    for (place, text) in texts {
        count += 1;
        let text = text.as_ref();
        if let Some(phrase) = rejected(text) {
            wrong.push(format!("{place}: '{phrase}' in: {text}"));
        }
    }
    assert!(count > 0, "no texts");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
