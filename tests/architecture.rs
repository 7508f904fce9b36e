//! The layers, as the table in `src/lib.rs` lists them: a folder imports only from those
//! above it, and no files under `src` import each other in a cycle.

#[path = "architecture/graph.rs"]
mod graph;
#[path = "architecture/source.rs"]
mod source;

use graph::{Graph, Import};
use std::path::Path;

/// The file that starts the window, and the only one of the command line that may import from it.
const STARTS_THE_WINDOW: &str = "src/cli/window.rs";

/// Reads every file under `src`.
fn sources() -> Vec<(String, String)> {
    fn read_folder(folder: &Path, root: &Path, sources: &mut Vec<(String, String)>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                read_folder(&path, root, sources);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = std::fs::read_to_string(&path).unwrap();
                let name = path.strip_prefix(root).unwrap().display().to_string();
                sources.push((name, text));
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = Vec::new();
    read_folder(&root.join("src"), root, &mut sources);
    sources.sort();
    assert!(sources.len() > 100, "only {} files", sources.len());
    sources
}

/// Returns the layers in the order of the table in the crate's documentation. A row may hold several
/// layers; a row of a submodule belongs to its folder's.
fn layers(lib: &str) -> Vec<Vec<String>> {
    let mut layers: Vec<Vec<String>> = Vec::new();
    for line in lib.lines().filter(|line| line.starts_with("//! | [`")) {
        let cell = line.split('|').nth(1).unwrap();
        let names: Vec<String> = cell
            .split('`')
            .skip(1)
            .step_by(2)
            .map(|name| name.split("::").next().unwrap().to_owned())
            .filter(|name| !layers.iter().flatten().any(|known| known == name))
            .collect();
        if !names.is_empty() {
            layers.push(names);
        }
    }
    layers
}

/// Returns the rank of a file's layer: files import from lower ranks and from their own layer.
fn rank(layers: &[Vec<String>], file: &str) -> usize {
    let name = layer(file);
    let is_it = |row: &Vec<String>| row.iter().any(|layer| layer == name);
    match (name, layers.iter().position(is_it)) {
        (_, Some(row)) => row,
        // It declares the layers.
        ("lib", None) => 0,
        ("main", None) => layers.len(),
        (name, None) => panic!("{name} is missing from the table in src/lib.rs"),
    }
}

fn layer(file: &str) -> &str {
    let name = file.strip_prefix("src/").unwrap();
    let name = name.split('/').next().unwrap();
    name.strip_suffix(".rs").unwrap_or(name)
}

/// Returns the imports of a higher layer, or of another layer of the same row.
fn upward(graph: &Graph, layers: &[Vec<String>]) -> Vec<Import> {
    let is_upward = |import: &&Import| {
        let [from, to] = [&graph.files[import.from], &graph.files[import.to]];
        layer(from) != layer(to) && rank(layers, from) <= rank(layers, to)
    };
    graph.imports.iter().filter(is_upward).cloned().collect()
}

/// Tells the files of a cycle and the imports between them.
fn describe_cycle(graph: &Graph, cycle: &[usize]) -> String {
    let within = |import: &&Import| cycle.contains(&import.from) && cycle.contains(&import.to);
    let imports = graph.imports.iter().filter(within);
    let lines: Vec<_> = imports.map(|import| graph.describe(import)).collect();
    format!("cycle of {} files:\n{}", cycle.len(), lines.join("\n"))
}

#[test]
fn no_layer_imports_from_one_above_it() {
    let sources = sources();
    let (_, lib) = sources
        .iter()
        .find(|(path, _)| path == "src/lib.rs")
        .unwrap();
    let layers = layers(lib);
    assert!(layers.len() >= 8, "{layers:?}");
    let graph = Graph::new(&sources);
    assert!(
        graph.imports.len() > 1000,
        "{} imports",
        graph.imports.len()
    );
    let mut found = upward(&graph, &layers);
    found.retain(|import| {
        let [from, to] = [import.from, import.to].map(|file| graph.files[file].as_str());
        from != STARTS_THE_WINDOW || layer(to) != "gui"
    });
    let lines: Vec<_> = found.iter().map(|import| graph.describe(import)).collect();
    assert!(lines.is_empty(), "upward:\n{}", lines.join("\n"));
}

#[test]
fn no_files_import_each_other_in_a_cycle() {
    let graph = Graph::new(&sources());
    let cycles: Vec<_> = graph
        .cycles()
        .iter()
        .map(|cycle| describe_cycle(&graph, cycle))
        .collect();
    assert!(cycles.is_empty(), "{}", cycles.join("\n\n"));
}

#[test]
fn the_command_line_and_the_window_import_each_other_only_to_start_the_window() {
    let graph = Graph::new(&sources());
    let mut starts = 0;
    for import in &graph.imports {
        let [from, to] = [import.from, import.to].map(|file| graph.files[file].as_str());
        match (layer(from), layer(to)) {
            ("cli", "gui") if from == STARTS_THE_WINDOW => starts += 1,
            ("cli", "gui") | ("gui", "cli") => panic!("{}", graph.describe(import)),
            _ => {}
        }
    }
    assert!(starts > 0, "nothing starts the window");
}

/// A crate made up of these files, with the layers `low` and `high`.
fn made_up(files: &[(&str, &str)]) -> (Graph, Vec<Vec<String>>) {
    let file = |&(path, text): &(&str, &str)| (path.to_owned(), text.to_owned());
    let lib =
        "//! | [`low`] | |\n//! | [`low::a`] | |\n//! | [`high`] | |\npub mod low; pub mod high;";
    let mut sources = vec![("src/lib.rs".to_owned(), lib.to_owned())];
    sources.extend(files.iter().map(file));
    (Graph::new(&sources), layers(lib))
}

fn edges(graph: &Graph) -> Vec<(&str, &str)> {
    let name = |file: usize| graph.files[file].as_str();
    let edge = |import: &Import| (name(import.from), name(import.to));
    let mut edges: Vec<_> = graph.imports.iter().map(edge).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

#[test]
fn an_upward_import_is_found_in_use_items_and_in_code() {
    let high = (
        "src/high/mod.rs",
        "pub struct Top; pub fn top() {} use crate::low::Base;",
    );
    let ways = [
        "pub struct Base; use crate::high::Top;",
        "pub struct Base; use crate::{high::{self, Top as T}};",
        "pub struct Base; use super::high; fn f() { high::top() }",
        "pub struct Base; fn f() { println!(\"{:?}\", crate::high::top()) }",
        "pub struct Base; mod inner { pub fn f() { super::super::high::top() } }",
    ];
    for low in ways {
        let (graph, layers) = made_up(&[("src/low/mod.rs", low), high]);
        let upward = upward(&graph, &layers);
        assert!(!upward.is_empty(), "{low}");
        let message = graph.describe(&upward[0]);
        assert!(message.contains("src/low/mod.rs:1 imports"), "{message}");
    }
    let (graph, layers) = made_up(&[("src/low/mod.rs", "pub struct Base;"), high]);
    assert_eq!(edges(&graph), [("src/high/mod.rs", "src/low/mod.rs")]);
    assert!(upward(&graph, &layers).is_empty());
}

#[test]
fn comments_strings_and_unit_tests_import_nothing() {
    let low = "
        //! [`crate::high::Top`]
        /* use crate::high::Top; */
        pub struct Base;
        const TEXT: &str = \"crate::high::Top\";
        #[cfg(test)]
        use crate::high::{Top, top};
        #[cfg(test)]
        mod tests { use crate::high::Top; }
    ";
    let high = ("src/high/mod.rs", "pub struct Top; pub fn top() {}");
    let (graph, _) = made_up(&[("src/low/mod.rs", low), high]);
    assert_eq!(edges(&graph), []);
}

#[test]
fn cycles_are_found_through_reexports() {
    let low = (
        "src/low/mod.rs",
        "mod a; mod b; mod c; pub use a::{A, Other}; pub use b::B;",
    );
    let high = ("src/high/mod.rs", "");
    let a = "use super::B; pub struct A(B); pub struct Other;";
    let c = ("src/low/c.rs", "use super::{A, B};");
    let files = |b| [low, high, c, ("src/low/a.rs", a), ("src/low/b.rs", b)];
    // A module that only declares and re-exports is part of no cycle.
    let (graph, _) = made_up(&files("pub struct B;"));
    assert_eq!(graph.cycles(), [[0; 0]; 0]);
    let expected = [
        ("src/low/a.rs", "src/low/b.rs"),
        ("src/low/c.rs", "src/low/a.rs"),
        ("src/low/c.rs", "src/low/b.rs"),
    ];
    assert_eq!(edges(&graph), expected);

    for b in [
        "pub struct B(super::Other);",
        "use super::*; pub struct B(Other);",
    ] {
        let (graph, _) = made_up(&files(b));
        let cycles = graph.cycles();
        assert_eq!(cycles.len(), 1, "{b}");
        let message = describe_cycle(&graph, &cycles[0]);
        assert!(message.starts_with("cycle of 2 files"), "{message}");
        assert!(message.contains("src/low/a.rs:1 imports super::B of src/low/b.rs"));
        assert!(
            message.contains("src/low/b.rs:1 imports super::"),
            "{message}"
        );
    }
}

#[test]
fn a_module_that_uses_what_it_reexports_depends_on_it() {
    let low = "mod a; pub use a::A; pub struct Base; pub fn f() -> A { todo() }";
    let a = ("src/low/a.rs", "pub struct A(super::Base);");
    let (graph, _) = made_up(&[("src/low/mod.rs", low), a, ("src/high/mod.rs", "")]);
    assert_eq!(graph.cycles().len(), 1);
}
