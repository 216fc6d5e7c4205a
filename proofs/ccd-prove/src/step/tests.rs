use super::*;

#[test]
fn each_opcode_is_that_of_its_step() {
    for opcode in 0..=7 {
        assert_eq!(Step::from_opcode(opcode).unwrap().opcode(), opcode);
    }
    assert_eq!(Step::from_opcode(8), None);
}
