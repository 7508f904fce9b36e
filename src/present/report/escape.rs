//! Escapes the reserved characters of markup languages.

/// Escapes the characters that are markup in Markdown.
pub fn markdown(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if matches!(c, '\\' | '`' | '*' | '_' | '|' | '<' | '[' | '#') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Replaces the characters that are reserved in LaTeX or missing from its older fonts.
pub fn latex(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => {
                out.push('\\');
                out.push(c);
            }
            '\\' => out += "\\textbackslash{}",
            '~' => out += "\\textasciitilde{}",
            '^' => out += "\\textasciicircum{}",
            '³' => out += "$^3$",
            'Δ' => out += "$\\Delta$",
            'Λ' => out += "$\\Lambda$",
            '–' => out += "--",
            '≠' => out += "$\\neq$",
            '→' => out += "$\\to$",
            c => out.push(c),
        }
    }
    out
}
