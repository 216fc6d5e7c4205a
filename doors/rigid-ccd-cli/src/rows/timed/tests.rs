use super::*;

/// Tests that no rounding shows: as seconds, many of these durations have a dozen digits more.
#[test]
fn microseconds_have_at_most_three_decimals() {
    for nanoseconds in (1..1_000_000).step_by(7) {
        let text = microseconds(Duration::from_nanos(nanoseconds)).to_string();
        let decimals = text
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        assert!(decimals <= 3, "{text}");
        let whole: String = text.chars().filter(|&own| own != '.').collect();
        let scaled = whole.parse::<u64>().unwrap() * 10u64.pow(3 - decimals as u32);
        assert_eq!(scaled, nanoseconds, "{text}");
    }
}
