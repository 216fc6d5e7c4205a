//! Tests that an emptied list gives back its memory beyond `MAX_KEPT_BYTES`.

use super::*;

#[test]
fn a_list_keeps_its_memory_up_to_the_bound() {
    let most = MAX_KEPT_BYTES / size_of::<[u32; 4]>();
    for (needed, kept) in [(most / 2, most / 2), (most, most), (2 * most, most)] {
        let mut list = vec![[1; 4]; needed];
        clear_and_shrink(&mut list);
        assert_eq!((list.len(), list.capacity()), (0, kept));
    }
}
