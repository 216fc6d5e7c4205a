//! Tests `ccd completions` and `ccd man`.

use crate::command::{CommandCall, Scene, assert_contains};
use rstest::rstest;
use std::fs;

#[rstest]
#[case("bash")]
#[case("elvish")]
#[case("fish")]
#[case("powershell")]
#[case("zsh")]
fn every_shell_completes_commands_and_options(#[case] shell: &str) {
    let output = CommandCall::with_args(&["completions", shell]).run_expecting_code(0);
    let script = String::from_utf8(output.stdout).unwrap();
    // A fish script names long options without their dashes.
    let option = if shell == "fish" {
        "-l motions"
    } else {
        "--motions"
    };
    for word in ["query", option] {
        assert!(script.contains(word), "{shell}: {word}");
    }
}

#[test]
fn an_unknown_shell_is_refused() {
    let message = CommandCall::with_args(&["completions", "cmd"]).run_for_messages(2);
    assert_contains(&message, "powershell");
}

#[test]
fn the_command_and_every_subcommand_have_a_man_page() {
    let scene = Scene::new("man");
    CommandCall::with_args(&["man", scene.directory.to_str().unwrap()]).run_expecting_code(0);
    for (page, word) in [
        ("ccd", "query"),
        ("ccd-query", "motions"),
        ("ccd-decompose", "pieces"),
        ("ccd-completions", "shell"),
        ("ccd-man", "FOLDER"),
    ] {
        let text = fs::read_to_string(scene.directory.join(format!("{page}.1"))).unwrap();
        assert!(text.contains(".TH") && text.contains(word), "{page}");
    }
}

#[test]
fn man_pages_need_an_existing_folder() {
    let folder = Scene::new("man-missing").directory.join("gone");
    let message = CommandCall::with_args(&["man", folder.to_str().unwrap()]).run_for_messages(1);
    assert!(
        message.contains("cannot write") && message.contains("gone"),
        "{message}"
    );
}
