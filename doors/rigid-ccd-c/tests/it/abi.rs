//! Tests that the binary interface stays compatible with programs that were built against it.
//!
//! `abi.txt` lists each function with its arguments, each value of an enum, and the offset and size of each field, as a
//! compiler for 64-bit Linux sees them. A changed or removed line breaks programs. New lines do not; add them to the
//! file.

use crate::programs::{folder, run, static_library};
use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

/// Returns the header without comments and without lines of the preprocessor.
fn header() -> String {
    let text = fs::read_to_string(folder().join("include/rigid_ccd.h")).unwrap();
    let (_, text) = text.split_once("#define RIGID_CCD_H").unwrap();
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    let code = lines.filter(|line| !line.starts_with('#'));
    code.collect::<Vec<_>>().join("\n")
}

/// Returns the declarations of functions, each on one line.
fn functions(header: &str) -> Vec<String> {
    let declarations = header.split(';');
    let words = declarations.map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
    let functions = words.filter(|text| text.contains("rccd_") && text.ends_with(')'));
    functions
        .map(|text| text.trim_start_matches("extern \"C\" { ").to_owned())
        .collect()
}

/// Returns the names of each struct with those of its fields.
fn structs(header: &str) -> Vec<(String, Vec<String>)> {
    let parts = header.split("typedef struct ").skip(1);
    let with_fields = parts.filter_map(|part| {
        let (name, rest) = part.split_once(" {")?;
        if name.contains(';') {
            return None;
        }
        let (fields, _) = rest.split_once('}')?;
        let fields = fields.split(';').filter_map(|field| {
            let name = field.split_whitespace().last()?.trim_start_matches('*');
            Some(name.split('[').next()?.to_owned())
        });
        Some((name.to_owned(), fields.collect()))
    });
    with_fields.collect()
}

/// Returns the values of all enums.
fn values(header: &str) -> Vec<String> {
    let lines = header.lines().map(str::trim);
    let values = lines.filter(|line| line.starts_with("RCCD_") && line.contains('='));
    values
        .map(|line| line.trim_end_matches(',').to_owned())
        .collect()
}

/// Returns the layout of structs by a compiler: one line for each struct and each field.
fn layout(structs: &[(String, Vec<String>)]) -> String {
    let mut program =
        String::from("#include \"rigid_ccd.h\"\n#include <stdio.h>\nint main(void) {\n");
    for (name, fields) in structs {
        // A struct that begins with its size may grow.
        if fields[0] != "size" {
            let line = format!("printf(\"struct {name}: %zu bytes\\n\", sizeof({name}));\n");
            program += &line;
        }
        for field in fields {
            let size = format!("sizeof((({name} *)0)->{field})");
            let place = format!("offsetof({name}, {field})");
            let line = format!("{name}.{field}: at %zu, %zu bytes");
            program += &format!("printf(\"{line}\\n\", {place}, {size});\n");
        }
    }
    program += "}\n";
    let scene = tempfile::tempdir().unwrap();
    let [source, binary] = ["layout.c", "layout"].map(|name| scene.path().join(name));
    fs::write(&source, program).unwrap();
    run(Command::new("cc")
        .arg("-std=c99")
        .arg(format!("-I{}", folder().join("include").display()))
        .args([&source, &"-o".into(), &binary]));
    run(&mut Command::new(&binary))
}

#[test]
#[cfg(all(target_os = "linux", target_pointer_width = "64"))]
fn what_programs_were_built_against_stays() {
    let header = header();
    let (functions, structs, values) = (functions(&header), structs(&header), values(&header));
    assert!(functions.len() > 40 && structs.len() > 8 && values.len() > 30);
    let now = [functions.join("\n"), values.join("\n"), layout(&structs)].join("\n");
    let committed = fs::read_to_string(folder().join("tests/abi.txt")).unwrap();
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<BTreeSet<_>>();
    let (now_lines, committed) = (lines(&now), lines(&committed));
    let changed: Vec<_> = committed.difference(&now_lines).collect();
    let fresh = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("abi.txt");
    fs::write(&fresh, now).unwrap();
    assert!(changed.is_empty(), "programs break that use {changed:#?}");
    let new: Vec<_> = now_lines.difference(&committed).collect();
    let fresh = fresh.display();
    assert!(
        new.is_empty(),
        "replace tests/abi.txt by {fresh}; it lacks {new:#?}"
    );
}

#[test]
fn the_library_defines_each_function_of_the_header() {
    let defined = run(Command::new("nm")
        .arg("--defined-only")
        .arg(static_library()));
    let defined: BTreeSet<&str> = defined
        .lines()
        .filter_map(|line| line.split(" T ").nth(1))
        .filter(|name| name.starts_with("rccd_"))
        .collect();
    let functions = functions(&header());
    let declared: BTreeSet<&str> = functions
        .iter()
        .map(|text| {
            let name = text.split('(').next().unwrap();
            name.split([' ', '*']).next_back().unwrap()
        })
        .collect();
    assert_eq!(defined, declared);
}
