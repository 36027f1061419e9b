model A
  G g(v = {Line(p = 1), Text(s = 1), Bitmap(m = 1)});
end A;
