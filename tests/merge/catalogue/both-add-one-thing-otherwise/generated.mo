model A
  Body m;
end A;
