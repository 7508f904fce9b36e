//! What one source file declares, imports and names.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::collections::BTreeSet;

/// A path as written, such as `["crate", "scene", "Camera"]`.
pub type Path = Vec<String>;

/// One name that a `use` item brings into scope.
#[derive(Debug)]
pub struct Use {
    pub path: Path,
    /// The name in scope; `*` for a glob.
    pub name: String,
    /// Whether other modules may import the name from here.
    pub is_public: bool,
}

/// A module: a whole file, or the body of an inline `mod`.
#[derive(Debug, Default)]
pub struct Module {
    /// From the crate root: `["scene", "camera"]`.
    pub path: Path,
    /// The index of its file.
    pub file: usize,
    /// Names of the items defined here.
    pub items: BTreeSet<String>,
    /// Names of child modules.
    pub children: BTreeSet<String>,
    pub uses: Vec<Use>,
    /// Paths of at least two segments in code.
    pub paths: BTreeSet<Path>,
    /// Every identifier in code.
    pub identifiers: BTreeSet<String>,
}

/// Reads one file. Returns its module and the inline modules in it. Skips whatever is compiled only
/// for unit tests.
pub fn read(text: &str, path: Path, file: usize) -> Vec<Module> {
    let tokens: TokenStream = text.parse().expect("Rust source");
    let mut modules = Vec::new();
    read_module(tokens, path, file, &mut modules);
    modules
}

fn read_module(tokens: TokenStream, path: Path, file: usize, modules: &mut Vec<Module>) {
    let mut module = Module {
        path,
        file,
        ..Module::default()
    };
    let mut inline = Vec::new();
    read_tokens(tokens, true, &mut module, &mut inline);
    let path = module.path.clone();
    modules.push(module);
    for (name, body) in inline {
        let path = path.iter().cloned().chain([name]).collect();
        read_module(body, path, file, modules);
    }
}

/// Reads tokens into `module`; `is_item_level` unless they are inside a body.
fn read_tokens(
    tokens: TokenStream,
    is_item_level: bool,
    module: &mut Module,
    inline: &mut Vec<(String, TokenStream)>,
) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut at = 0;
    while at < tokens.len() {
        if is_test_attribute(&tokens[at..]) {
            at = end_of_item(&tokens, at + 2);
            continue;
        }
        match &tokens[at] {
            TokenTree::Ident(word) => {
                let word = word.to_string();
                let next = tokens.get(at + 1).and_then(identifier);
                match (word.as_str(), next) {
                    ("use", _) if !is_capture(&tokens, at) => {
                        let end = end_of_item(&tokens, at);
                        let tree = &tokens[at + 1..end - 1];
                        let is_public = is_public(&tokens[..at]);
                        read_use(tree, &Path::new(), is_public, &mut module.uses);
                        at = end;
                        continue;
                    }
                    ("mod", Some(name)) => {
                        module.children.insert(name.clone());
                        if let Some(body) = tokens.get(at + 2).and_then(braces) {
                            inline.push((name, body.stream()));
                        }
                        at += 3;
                        continue;
                    }
                    (
                        "fn" | "struct" | "enum" | "trait" | "type" | "const" | "static" | "union",
                        Some(name),
                    ) if is_item_level => {
                        module.items.insert(name);
                    }
                    ("macro_rules", _) => {
                        let name = tokens.get(at + 2).and_then(identifier);
                        module.items.extend(name);
                    }
                    _ => {}
                }
                module.identifiers.insert(word);
                if !follows_path_separator(&tokens, at) {
                    let path = path_at(&tokens, at);
                    if path.len() > 1 {
                        module.paths.insert(path);
                    }
                }
            }
            TokenTree::Group(group) => read_tokens(group.stream(), false, module, inline),
            _ => {}
        }
        at += 1;
    }
}

/// Reads a `use` tree after `prefix`.
fn read_use(tree: &[TokenTree], prefix: &Path, is_public: bool, uses: &mut Vec<Use>) {
    let mut path = prefix.clone();
    let mut name = None;
    let mut at = 0;
    while at < tree.len() {
        match &tree[at] {
            TokenTree::Ident(word) if word == "as" => {
                name = tree.get(at + 1).map(ToString::to_string);
                break;
            }
            TokenTree::Ident(word) => path.push(word.to_string()),
            TokenTree::Punct(p) if p.as_char() == '*' => name = Some("*".into()),
            TokenTree::Group(group) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                let is_comma =
                    |t: &TokenTree| matches!(t, TokenTree::Punct(p) if p.as_char() == ',');
                for branch in inner.split(is_comma).filter(|branch| !branch.is_empty()) {
                    read_use(branch, &path, is_public, uses);
                }
                return;
            }
            _ => {}
        }
        at += 1;
    }
    // `use a::{self}` brings `a` into scope.
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    uses.push(Use {
        name: name.unwrap_or_else(|| path.last().unwrap().clone()),
        path,
        is_public,
    });
}

/// Whether `#[cfg(test)]`, alone or with other conditions, begins here.
fn is_test_attribute(tokens: &[TokenTree]) -> bool {
    let [TokenTree::Punct(hash), TokenTree::Group(attribute), ..] = tokens else {
        return false;
    };
    let text = attribute.stream().to_string().replace(' ', "");
    hash.as_char() == '#' && (text == "cfg(test)" || text.starts_with("cfg(all(test,"))
}

/// Returns the index after the item that begins at `at`.
fn end_of_item(tokens: &[TokenTree], at: usize) -> usize {
    let mut words = tokens[at..].iter().filter_map(identifier);
    let is_use = words.find(|word| word != "pub").as_deref() == Some("use");
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(p) => p.as_char() == ';',
        TokenTree::Group(group) => !is_use && group.delimiter() == Delimiter::Brace,
        _ => false,
    };
    let length = tokens[at..].iter().position(ends);
    length.map_or(tokens.len(), |length| at + length + 1)
}

/// Whether the tokens before an item end with `pub` or `pub(…)`.
fn is_public(before: &[TokenTree]) -> bool {
    let before = match before {
        [rest @ .., TokenTree::Group(_)] => rest,
        _ => before,
    };
    before.last().and_then(identifier).as_deref() == Some("pub")
}

/// Whether the `use` at `at` lists captured generics, as in `impl Trait + use<'a>`.
fn is_capture(tokens: &[TokenTree], at: usize) -> bool {
    matches!(tokens.get(at + 1), Some(TokenTree::Punct(p)) if p.as_char() == '<')
}

fn follows_path_separator(tokens: &[TokenTree], at: usize) -> bool {
    at >= 2 && is_path_separator(&tokens[at - 2..])
}

fn is_path_separator(tokens: &[TokenTree]) -> bool {
    let is_colon = |t: &TokenTree| matches!(t, TokenTree::Punct(p) if p.as_char() == ':');
    tokens.len() >= 2 && tokens[..2].iter().all(is_colon)
}

/// Returns the path whose first segment stands at `at`.
fn path_at(tokens: &[TokenTree], mut at: usize) -> Path {
    let mut path = Path::new();
    while let Some(segment) = tokens.get(at).and_then(identifier) {
        path.push(segment);
        if !is_path_separator(&tokens[at + 1..]) {
            break;
        }
        at += 3;
    }
    path
}

fn identifier(token: &TokenTree) -> Option<String> {
    match token {
        TokenTree::Ident(word) => Some(word.to_string()),
        _ => None,
    }
}

fn braces(token: &TokenTree) -> Option<&Group> {
    match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group),
        _ => None,
    }
}
