use super::Excerpt;

#[test]
fn long_texts_are_cut_between_characters() {
    assert_eq!(Excerpt("é,\"x\"").to_string(), "é,\"x\"");
    let most = "é".repeat(60);
    assert_eq!(Excerpt(&most).to_string(), most);
    let longer = format!("{most}xyz");
    assert_eq!(Excerpt(&longer).to_string(), format!("{most}… (123 bytes)"));
}
