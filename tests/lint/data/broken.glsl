// Wrong in both languages: the compilers must say so with this file's name and the line below.
RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  float x = nobodyDeclaredThis(pixel);
}
