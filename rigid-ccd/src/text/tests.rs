use super::{Excerpt, Number};

#[test]
fn numbers_are_short() {
    let numbers = [0.0, -1.0, 0.001, 1e-320, -1e308, 12_345.5, f64::INFINITY];
    let texts = ["0", "-1", "0.001", "1e-320", "-1e308", "12345.5", "inf"];
    assert_eq!(numbers.map(|number| Number(number).to_string()), texts);
}

#[test]
fn long_texts_are_cut_between_characters() {
    assert_eq!(Excerpt("é,\"x\"").to_string(), "é,\"x\"");
    let most = "é".repeat(60);
    assert_eq!(Excerpt(&most).to_string(), most);
    let longer = format!("{most}xyz");
    assert_eq!(Excerpt(&longer).to_string(), format!("{most}… (123 bytes)"));
}
