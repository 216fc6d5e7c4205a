use super::*;

fn table(name: &str) -> TextTable {
    TextTable {
        name: name.to_owned(),
        title: "Title".to_owned(),
        header: vec!["scene".to_owned(), "x".to_owned()],
        rows: vec![vec!["santa".to_owned(), "1.5".to_owned()]],
    }
}

#[test]
fn text_between_the_markers_is_replaced_and_nothing_else() {
    let text = "a\n<!-- ccd chart: usual -->\nold\n<!-- end -->\nb\n";
    let once = with_tables(text, &[table("fine"), table("usual")]).unwrap();
    assert!(once.starts_with("a\n<!-- ccd chart: usual -->\nTitle:\n\n| scene"));
    assert!(once.contains("santa") && !once.contains("old"));
    assert!(once.ends_with("<!-- end -->\nb\n"));
    assert_eq!(with_tables(&once, &[table("usual")]).unwrap(), once);
}

#[test]
fn a_file_without_markers_is_refused() {
    assert!(with_tables("nothing", &[table("usual")]).is_err());
    assert!(with_tables("<!-- ccd chart: usual -->\n", &[table("usual")]).is_err());
}
