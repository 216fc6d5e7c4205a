use super::*;

#[test]
fn every_type_and_piece_is_made_once() {
    let cache_table = CacheTable::default();
    for _ in 0..2 {
        assert_eq!(*cache_table.entry::<u32>(3, 1).get_or_init(|| 7), 7);
        let text = cache_table.entry::<String>(3, 1);
        assert_eq!(text.get_or_init(|| "seven".to_owned()), "seven");
        assert_eq!(*cache_table.entry::<u32>(3, 2).get_or_init(|| 8), 8);
    }
    assert_eq!(cache_table.entry::<u32>(3, 1).get(), Some(&7));
    assert_eq!(cache_table.entry::<u32>(3, 0).get(), None);
    assert_eq!(cache_table.clone().entry::<u32>(3, 1).get(), None);
}
