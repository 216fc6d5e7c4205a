use super::*;

#[test]
fn an_unclosed_quote_is_reported_at_its_line() {
    let name = format!("ccd-measured-{}.csv", std::process::id());
    let file = std::env::temp_dir().join(name);
    for (text, expected) in [
        ("a,b\n1,x\n2,\"y\n3,z\n", Some("line 3: a quote")),
        ("a,b\n\"1,x\n2,y\n", Some("line 2: a quote")),
        ("a,b\n1,\"x\ny\"", None),
    ] {
        std::fs::write(&file, text).unwrap();
        let rows: Result<Vec<(u32, String)>, _> = read(&file);
        match (rows, expected) {
            (Ok(rows), None) => assert_eq!(rows, [(1, "x\ny".to_owned())]),
            (Err(error), Some(words)) => assert!(error.to_string().contains(words), "{error}"),
            other => panic!("{text:?}: {other:?}"),
        }
    }
    std::fs::remove_file(&file).unwrap();
}
