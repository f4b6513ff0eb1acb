// The program whose precompiled headers all tests share: it holds nothing else.
