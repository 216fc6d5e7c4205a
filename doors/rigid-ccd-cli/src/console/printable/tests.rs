use super::PrintableText;

#[test]
fn nothing_controls_a_terminal() {
    for (text, expected) in [
        ("café 部品 −1", "café 部品 −1"),
        ("\u{1b}[31mred\u{7}", "\\u{1b}[31mred\\u{7}"),
        ("over\rwritten\n\tline", "over\\rwritten\\n\\tline"),
        (
            "\u{9b}2J\u{0}\u{7f}\u{202e}txt.exe",
            "\\u{9b}2J\\u{0}\\u{7f}\\u{202e}txt.exe",
        ),
    ] {
        assert_eq!(PrintableText(text).to_string(), expected);
    }
}
