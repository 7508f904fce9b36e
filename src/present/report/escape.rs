//! Text with the characters that a markup language reserves escaped.

/// Text with the characters that Markdown would take for markup escaped.
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

/// Text with the characters that mean something to LaTeX, or that its old fonts lack, replaced.
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
