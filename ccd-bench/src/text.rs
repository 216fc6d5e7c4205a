//! Figures as people read them.

/// A count with its thousands set apart.
pub(crate) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn thousands_are_set_apart() {
        let counts = [0, 12, 999, 1_000, 69_664, 1_234_567];
        let texts = ["0", "12", "999", "1,000", "69,664", "1,234,567"];
        assert_eq!(counts.map(grouped), texts);
    }
}
