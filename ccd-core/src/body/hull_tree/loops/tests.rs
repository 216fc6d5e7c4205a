use super::*;

#[test]
fn loops_are_those_of_a_list_of_lists() {
    let nested: Vec<Vec<u32>> = vec![vec![3, 1, 2], vec![], vec![0, 1, 2, 3], vec![7]];
    let loops = PolygonList::from(nested.clone());
    assert!(loops.iter().eq(nested.iter().map(|l| &l[..])));
    assert!(loops.iter().rev().eq(nested.iter().rev().map(|l| &l[..])));
    assert_eq!(loops.corners(), nested.concat());
    assert_eq!((loops.len(), loops.get(4)), (4, None));
    assert!(PolygonList::default().is_empty());
    let mut pushed = PolygonList::with_capacity(4, 8);
    nested.iter().for_each(|corners| pushed.push(corners));
    assert_eq!(pushed, loops);
}

#[cfg(feature = "serde")]
#[test]
fn loops_are_stored_as_lists_of_lists() {
    let nested: Vec<Vec<u32>> = vec![vec![3, 1, 2], vec![], vec![0, 1, 2, 300]];
    let bytes = postcard::to_allocvec(&nested).unwrap();
    assert_eq!(
        postcard::to_allocvec(&PolygonList::from(nested.clone())),
        Ok(bytes.clone())
    );
    assert_eq!(postcard::from_bytes(&bytes), Ok(PolygonList::from(nested)));
}
