//! Tests that no source files of a crate import each other in a circle, and no folders.
//!
//! A file may use its own ancestors. All other imports count, also those inside of macros. Tests do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};

/// The path of a module within its crate. The crate's root is empty.
type Module = Vec<String>;

/// The modules of the same crate that each module of a crate imports.
type Imports = BTreeMap<Module, BTreeSet<Module>>;

const CRATES: [&str; 17] = [
    "ccd-core",
    "ccd-distance-gjk",
    "ccd-distance-vmarch",
    "ccd-decomp",
    "proofs/ccd-prove",
    "proofs/ccd-check",
    "files/ccd-file",
    "files/ccd-tables",
    "files/ccd-view",
    "ccd-bench",
    "rigid-ccd",
    "doors/rigid-ccd-cli",
    "doors/rigid-ccd-parry",
    "rigid-ccd-robot",
    "doors/rigid-ccd-c",
    "doors/js",
    "doors/python",
];

#[test]
fn no_files_import_each_other_in_a_circle() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (mut files, mut rooms) = (0, 0);
    for name in CRATES {
        let root = workspace.join(name).join("src/lib.rs");
        let texts = parsed_modules(&root);
        files += texts.len();
        let imports = imports_by_module(&texts);
        let circles = imports_leading_to_cycles(&imports);
        assert!(circles.is_empty(), "{name}: {circles:#?}");
        let imports = imports_by_room(&imports);
        rooms += imports.len();
        let circles = imports_leading_to_cycles(&imports);
        assert!(circles.is_empty(), "folders of {name}: {circles:#?}");
    }
    assert!(files > 500 && rooms > 200, "{files} {rooms}");
}

/// Tests that a circle is found by imports in `use`, in a path of an expression and in a macro, also between folders.
#[test]
fn a_circle_is_found() {
    let found = |end: &str, below: &str| {
        let root = "mod a; mod b; const NOTE: &str = \"mod c;\n//\";";
        let a = "mod c; use c::f;";
        let texts = [("", root), ("a", a), ("b", end), ("a/c", below)].map(|(module, text)| {
            let names = module.split('/').filter(|name| !name.is_empty());
            let file = syn::parse_file(text).expect("valid Rust");
            (names.map(str::to_owned).collect(), file)
        });
        imports_leading_to_cycles(&imports_by_module(&BTreeMap::from(texts))).len()
    };
    for end in [
        "use crate::a::{self, Thing};",
        "fn f() { crate::a::f() }",
        "fn f() { println!(\"{}\", super::a::f()) }",
    ] {
        assert_eq!(found(end, "use super::super::b;"), 3, "{end}");
        let in_tests = "#[cfg(test)] mod tests { use crate::b; }";
        assert_eq!(found(end, in_tests), 0, "{end}");
        assert_eq!(found(end, "use crate::a::Thing; // crate::b"), 0, "{end}");
    }
}

/// Tests that two folders that import each other are found, though none of their files do.
#[test]
fn a_circle_of_folders_is_found() {
    let modules = ["a/b/f", "a/b/g", "a/c/f", "a/c/g"];
    let module = |path: &str| path.split('/').map(str::to_owned).collect::<Module>();
    let imports = |arrows: &[(&str, &str)]| {
        let mut imports: Imports = modules.map(|path| (module(path), BTreeSet::new())).into();
        for (from, to) in arrows {
            imports.entry(module(from)).or_default().insert(module(to));
        }
        assert!(imports_leading_to_cycles(&imports).is_empty());
        imports_leading_to_cycles(&imports_by_room(&imports)).len()
    };
    assert_eq!(imports(&[("a/b/f", "a/c/f"), ("a/b/f", "a/b/g")]), 0);
    assert_eq!(imports(&[("a/b/f", "a/c/f"), ("a/c/g", "a/b/g")]), 2);
}

/// Parses the file of a crate's root and the files of all its modules, except tests.
fn parsed_modules(root: &Path) -> BTreeMap<Module, syn::File> {
    let mut texts = BTreeMap::new();
    let mut waiting = vec![(Module::new(), root.to_owned(), root.with_file_name(""))];
    while let Some((module, path, folder)) = waiting.pop() {
        let text = fs::read_to_string(&path).expect("a source file");
        let file = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        for item in &file.items {
            if let syn::Item::Mod(child) = item
                && child.content.is_none()
                && !is_test_only(&child.attrs)
            {
                let name = child.ident.to_string();
                let below = folder.join(&name);
                let path: PathBuf = below.with_extension("rs");
                waiting.push(([&module[..], &[name]].concat(), path, below));
            }
        }
        texts.insert(module, file);
    }
    texts
}

fn is_test_only(attributes: &[syn::Attribute]) -> bool {
    let is_test = |attribute: &syn::Attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        _ => false,
    };
    attributes.iter().any(is_test)
}

fn imports_by_module(texts: &BTreeMap<Module, syn::File>) -> Imports {
    let imports = texts.iter().map(|(module, file)| {
        let mut paths = PathCollector::default();
        paths.visit_file(file);
        let used = paths
            .0
            .iter()
            .filter_map(|path| module_of_path(texts, module, path));
        // A module is at home in those that it is a part of.
        let used = used.filter(|used| !module.starts_with(used));
        (module.clone(), used.collect())
    });
    imports.collect()
}

/// Returns the imports of rooms that stand beside each other: a module with all below it.
fn imports_by_room(imports: &Imports) -> Imports {
    let mut rooms = Imports::new();
    for (module, used) in imports {
        for other in used {
            let common = module.iter().zip(other).take_while(|(a, b)| a == b).count();
            if common < module.len() && common < other.len() {
                let room = rooms.entry(module[..=common].to_vec()).or_default();
                room.insert(other[..=common].to_vec());
            }
        }
    }
    rooms
}

/// Returns the module that a path in a module leads to; `None` if it leads out of the crate.
fn module_of_path(
    texts: &BTreeMap<Module, syn::File>,
    module: &[String],
    path: &[String],
) -> Option<Module> {
    let (mut at, mut rest) = (module.to_vec(), path);
    match path.first()?.as_str() {
        "crate" => (at, rest) = (Module::new(), &path[1..]),
        "self" => rest = &path[1..],
        "super" => {}
        first if !texts.contains_key(&[module, &[first.to_owned()]].concat()) => return None,
        _ => {}
    }
    for segment in rest {
        let below = [&at[..], std::slice::from_ref(segment)].concat();
        match segment.as_str() {
            "super" => drop(at.pop()),
            _ if texts.contains_key(&below) => at = below,
            _ => break,
        }
    }
    Some(at)
}

/// Collects the Rust paths (`a::b`) in a source file that may name another module of its crate.
#[derive(Default)]
struct PathCollector(Vec<Module>);

impl PathCollector {
    fn add_use_tree(&mut self, tree: &syn::UseTree, above: &[String]) {
        let below = |ident: &syn::Ident| [above, &[ident.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.add_use_tree(&path.tree, &below(&path.ident)),
            syn::UseTree::Name(name) => self.0.push(below(&name.ident)),
            syn::UseTree::Rename(name) => self.0.push(below(&name.ident)),
            syn::UseTree::Glob(_) => self.0.push(above.to_vec()),
            syn::UseTree::Group(group) => {
                for tree in &group.items {
                    self.add_use_tree(tree, above);
                }
            }
        }
    }
}

impl<'f> Visit<'f> for PathCollector {
    fn visit_item_mod(&mut self, module: &'f syn::ItemMod) {
        if !is_test_only(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_use(&mut self, item: &'f syn::ItemUse) {
        self.add_use_tree(&item.tree, &[]);
    }

    fn visit_path(&mut self, path: &'f syn::Path) {
        let segments = path.segments.iter();
        let segments: Module = segments.map(|segment| segment.ident.to_string()).collect();
        if ["crate", "self", "super"].contains(&segments[0].as_str()) && segments.len() > 1 {
            self.0.push(segments);
        }
        visit::visit_path(self, path);
    }

    /// Collects the paths in a macro call. They are found as text, because a macro's arguments have no syntax tree.
    fn visit_macro(&mut self, called: &'f syn::Macro) {
        let text = called.tokens.to_string().replace(' ', "");
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        for path in text.split(|c| !is_part(c)) {
            let segments: Module = path.split("::").map(str::to_owned).collect();
            if ["crate", "self", "super"].contains(&segments[0].as_str()) && segments.len() > 1 {
                self.0.push(segments);
            }
        }
    }
}

/// Returns the modules in import circles, and the modules that import these. Removes modules without imports until no
/// such module is left.
fn imports_leading_to_cycles(imports: &Imports) -> Imports {
    let mut left = imports.clone();
    loop {
        let before = left.len();
        let names: BTreeSet<Module> = left.keys().cloned().collect();
        for used in left.values_mut() {
            used.retain(|module| names.contains(module));
        }
        left.retain(|_, used| !used.is_empty());
        if left.len() == before {
            return left;
        }
    }
}
