//! Which file imports from which.

use crate::source::{Module, Path, read};
use std::collections::{BTreeMap, BTreeSet};

/// An import of a file by another, and the path it is written with.
#[derive(Clone, Debug)]
pub struct Import {
    pub from: usize,
    pub to: usize,
    pub path: String,
}

/// The files of a crate and the imports between them.
pub struct Graph {
    /// Paths such as `src/scene/mod.rs`.
    pub files: Vec<String>,
    pub imports: Vec<Import>,
    texts: Vec<String>,
    /// The files that each file imports.
    imported_by: Vec<BTreeSet<usize>>,
}

#[derive(Clone, Copy)]
enum Target {
    Module(usize),
    /// An item that this file defines.
    Item(usize),
}

struct Resolver {
    modules: Vec<Module>,
    by_path: BTreeMap<Path, usize>,
}

impl Graph {
    /// Reads a crate from pairs of path and text.
    pub fn new(sources: &[(String, String)]) -> Graph {
        let mut modules = Vec::new();
        for (file, (path, text)) in sources.iter().enumerate() {
            modules.extend(read(text, module_path(path), file));
        }
        let by_path = (0..modules.len()).map(|i| (modules[i].path.clone(), i));
        let by_path = by_path.collect();
        let resolver = Resolver { modules, by_path };
        let mut imports = Vec::new();
        for module in &resolver.modules {
            resolver.imports_of(module, &mut imports);
        }
        imports.retain(|import| import.from != import.to);
        let mut imported_by = vec![BTreeSet::new(); sources.len()];
        for import in &imports {
            imported_by[import.from].insert(import.to);
        }
        Graph {
            files: sources.iter().map(|(path, _)| path.clone()).collect(),
            texts: sources.iter().map(|(_, text)| text.clone()).collect(),
            imports,
            imported_by,
        }
    }

    /// Returns each cycle, as the sorted indices of its files: the strongly connected components of
    /// more than one file.
    pub fn cycles(&self) -> Vec<Vec<usize>> {
        let n = self.files.len();
        let reached: Vec<Vec<bool>> = (0..n).map(|file| self.reached_from(file)).collect();
        let is_in_cycle = |a: usize, b: usize| reached[a][b] && reached[b][a];
        let cycle_of = |file: usize| -> Vec<usize> {
            (0..n).filter(|&other| is_in_cycle(file, other)).collect()
        };
        (0..n)
            .map(|file| (file, cycle_of(file)))
            .filter(|(file, cycle)| cycle.first() == Some(file))
            .map(|(_, cycle)| cycle)
            .collect()
    }

    fn reached_from(&self, file: usize) -> Vec<bool> {
        let mut reached = vec![false; self.files.len()];
        let mut pending = vec![file];
        while let Some(file) = pending.pop() {
            for &next in &self.imported_by[file] {
                if !std::mem::replace(&mut reached[next], true) {
                    pending.push(next);
                }
            }
        }
        reached
    }

    pub fn describe(&self, import: &Import) -> String {
        let [from, to] = [&self.files[import.from], &self.files[import.to]];
        let line = line_of(&self.texts[import.from], &import.path);
        format!("{from}:{line} imports {} of {to}", import.path)
    }
}

/// Returns the number of the first line of code with this path, or with its last segment, which is all
/// that stands there in a `use` with braces.
fn line_of(text: &str, path: &str) -> usize {
    let last = path.rsplit("::").next().unwrap();
    let is_word = |line: &str| {
        let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.any(|word| word == last)
    };
    let mut lines = text.lines().map(|line| line.split("//").next().unwrap());
    let whole = lines.clone().position(|line| line.contains(path));
    let line = whole.or_else(|| lines.position(is_word));
    line.map_or(1, |line| line + 1)
}

/// Returns the module of a file: `src/scene/mod.rs` is `scene`.
fn module_path(file: &str) -> Path {
    let path = file.strip_prefix("src/").unwrap_or(file);
    let path = path.strip_suffix(".rs").unwrap();
    let mut path: Path = path.split('/').map(Into::into).collect();
    match path.last().unwrap().as_str() {
        "lib" if path.len() == 1 => path.clear(),
        "mod" => drop(path.pop()),
        _ => {}
    }
    path
}

impl Resolver {
    fn imports_of(&self, module: &Module, imports: &mut Vec<Import>) {
        let mut add = |to: usize, path: String| {
            let from = module.file;
            imports.push(Import { from, to, path });
        };
        for import in &module.uses {
            let is_named = module.identifiers.contains(&import.name);
            let path = import.path.join("::");
            for target in self.resolve(module, &import.path, 0) {
                match target {
                    // A re-export alone is no dependency.
                    Target::Item(file) if !import.is_public || is_named => {
                        add(file, path.clone());
                    }
                    Target::Module(imported) if import.name == "*" => {
                        let names = module.identifiers.iter();
                        for target in names.flat_map(|name| self.find(imported, name, 0)) {
                            if let Target::Item(file) = target {
                                add(file, format!("{path}::*"));
                            }
                        }
                    }
                    // Paths that begin with the module's name say which of its items are meant.
                    Target::Module(imported) if !import.is_public && !is_named => {
                        add(self.modules[imported].file, path.clone());
                    }
                    _ => {}
                }
            }
        }
        for path in &module.paths {
            for target in self.resolve(module, path, 0) {
                if let Target::Item(file) = target {
                    add(file, path.join("::"));
                }
            }
        }
    }

    /// Resolves a path written in `module` to all that it may mean: a module and a function may share
    /// a name. Returns nothing for a path into another crate.
    fn resolve(&self, module: &Module, path: &[String], depth: usize) -> Vec<Target> {
        let mut at = module.path.clone();
        let mut rest = path;
        while let [first, others @ ..] = rest {
            match first.as_str() {
                "crate" | "bspscope" => at.clear(),
                "super" => drop(at.pop()),
                "self" => {}
                _ => break,
            }
            rest = others;
        }
        let is_relative = rest.len() == path.len();
        let Some(&start) = self.by_path.get(&at) else {
            return Vec::new();
        };
        let mut targets = vec![Target::Module(start)];
        for (i, name) in rest.iter().enumerate() {
            let module = targets.iter().find_map(|target| match target {
                Target::Module(module) => Some(*module),
                Target::Item(_) => None,
            });
            // What follows an item is its variant or associated item.
            let Some(within) = module else { break };
            targets = self.find(within, name, depth);
            if targets.is_empty() && !(i == 0 && is_relative) {
                // A macro defines it.
                targets = vec![Target::Item(self.modules[within].file)];
            }
        }
        targets
    }

    /// Looks up a name in a module.
    fn find(&self, within: usize, name: &str, depth: usize) -> Vec<Target> {
        let module = &self.modules[within];
        let mut targets = Vec::new();
        if module.children.contains(name) {
            let path: Path = module.path.iter().cloned().chain([name.into()]).collect();
            targets.extend(self.by_path.get(&path).map(|&child| Target::Module(child)));
        }
        if module.items.contains(name) {
            targets.push(Target::Item(module.file));
        }
        // Modules may import each other's globs, or re-export in a circle through a child's name.
        if depth > 4 {
            return targets;
        }
        for import in &module.uses {
            if import.name == name {
                targets.extend(self.resolve(module, &import.path, depth + 1));
            } else if import.name == "*" {
                for target in self.resolve(module, &import.path, depth + 1) {
                    if let Target::Module(globbed) = target {
                        targets.extend(self.find(globbed, name, depth + 1));
                    }
                }
            }
        }
        targets
    }
}
