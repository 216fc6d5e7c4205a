use super::Number;

#[cfg(feature = "command")]
#[test]
fn nothing_controls_a_terminal() {
    use super::PrintableText;
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

#[test]
fn numbers_are_short() {
    let numbers = [0.0, -1.0, 0.001, 1e-320, -1e308, 12_345.5, f64::INFINITY];
    let texts = ["0", "-1", "0.001", "1e-320", "-1e308", "12345.5", "inf"];
    assert_eq!(numbers.map(|number| Number(number).to_string()), texts);
}
