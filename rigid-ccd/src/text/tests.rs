use super::Number;

#[test]
fn numbers_are_short() {
    let numbers = [0.0, -1.0, 0.001, 1e-320, -1e308, 12_345.5, f64::INFINITY];
    let texts = ["0", "-1", "0.001", "1e-320", "-1e308", "12345.5", "inf"];
    assert_eq!(numbers.map(|number| Number(number).to_string()), texts);
}
